#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "server/service/jobs/job.h"
#include "server/service/ops/folders.h"

namespace metamer::service {

/// Jobs without workers and sockets, and a store of their assets.
class JobTest : public testing::Test {
 protected:
  TemporaryFolder folder_ = TemporaryFolder::make().value();
  std::shared_ptr<AssetStore> store_ = AssetStore::open(folder_.path() / "store", 1000).value();

  static v1::Plan plan(std::uint32_t width, std::uint32_t height, std::uint32_t tile) {
    v1::Plan plan;
    plan.set_width(width);
    plan.set_height(height);
    plan.set_tile_size(tile);
    return plan;
  }
  std::shared_ptr<Job> make_job() {
    return std::make_shared<Job>(7, v1::Submit(), AssetHolds(*store_), 0);
  }
  std::shared_ptr<Job> running_job() {
    auto job = make_job();
    EXPECT_TRUE(job->start());
    EXPECT_TRUE(job->plan(plan(32, 16, 16)));
    EXPECT_TRUE(job->make_film());
    return job;
  }
  static std::vector<v1::JobEvent> read(const Job& job, EventLog::Filter filter,
                                        std::uint64_t from = 1) {
    std::vector<v1::JobEvent> events;
    while (const auto entry = job.log().next(from, filter)) {
      if (!events.empty() && entry->sequence <= events.back().sequence()) break;
      events.push_back(job.event(*entry, false).value());
      from = entry->sequence + 1;
    }
    return events;
  }
};

}  // namespace metamer::service
