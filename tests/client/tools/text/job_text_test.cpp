// How jobs, plans and times read.
#include "client/tools/text/job_text.h"

#include <gtest/gtest.h>

namespace metamer::client {
namespace {

TEST(Clock, CountsUpToHours) {
  EXPECT_EQ(clock(0), "0:00");
  EXPECT_EQ(clock(6.2), "0:07");
  EXPECT_EQ(clock(61), "1:01");
  EXPECT_EQ(clock(3723), "1:02:03");
  EXPECT_EQ(clock(-1), "-:--");
  EXPECT_EQ(clock(0.0 / 0.0), "-:--");
}

TEST(PlanText, IsOneLine) {
  v1::Plan plan;
  plan.set_width(640);
  plan.set_height(480);
  plan.set_spp(1);
  plan.set_bands(61);
  plan.set_from(400);
  plan.set_to(700);
  plan.set_lights(2);
  plan.set_materials(1);
  plan.set_triangles(40000);
  plan.set_threads(2);
  plan.set_backend("cpu");
  plan.mutable_method()->mutable_point();
  EXPECT_EQ(describe(plan),
            "640x480, 1 sample per pixel, point at 61 wavelengths from 400 to 700 nm, 2 lights, "
            "1 material, 40000 triangles, 2 threads");
  plan.mutable_method()->mutable_point()->set_fitted(61);
  EXPECT_EQ(describe(plan),
            "640x480, 1 sample per pixel, point at 61 fitted wavelengths from 400 to 700 nm, 2 "
            "lights, 1 material, 40000 triangles, 2 threads");
  plan.mutable_method()->mutable_prefilter();
  EXPECT_EQ(describe(plan),
            "640x480, 1 sample per pixel, prefilter, 2 lights, 1 material, 40000 triangles, 2 "
            "threads");
  plan.mutable_method()->mutable_rgb();
  EXPECT_EQ(describe(plan),
            "640x480, 1 sample per pixel, rgb, 2 lights, 1 material, 40000 triangles, 2 threads");
}

TEST(JobLine, HoldsWhatAListNeeds) {
  v1::JobSummary job;
  job.set_job_id(7);
  job.set_name("booth.txtpb");
  job.set_state(v1::FAILED);
  job.set_tiles_done(120);
  job.set_tiles(300);
  job.set_age(42);
  job.set_reason("the worker was lost");
  EXPECT_EQ(
      describe(job, ""),
      "               7  failed         120/300      0:42  cpu  -  booth.txtpb  (the worker was "
      "lost)");
  job.set_user("alice");
  job.set_backend(v1::GL);
  job.set_state(v1::QUEUED);
  EXPECT_EQ(describe(job, "3f9c2a1b070707070707070707070707"),
            "      7@3f9c2a1b  queued         120/300      0:42  gl   alice  booth.txtpb");
}

TEST(JobLine, SaysWhatAJobWaitsFor) {
  v1::JobSummary job;
  job.set_state(v1::QUEUED);
  EXPECT_EQ(waiting_text(job), "waits: its turn is next");
  job.set_reason("no worker starts: exited with code 3\x1b");
  job.set_priority(-5);
  EXPECT_EQ(waiting_text(job), "waits: no worker starts: exited with code 3?; its priority is -5");
  job.set_state(v1::PAUSED);
  EXPECT_EQ(waiting_text(job), "waits: it is paused, until it is resumed");
  for (const v1::JobState state : {v1::RUNNING, v1::FINISHED, v1::FAILED, v1::CANCELLED}) {
    job.set_state(state);
    EXPECT_EQ(waiting_text(job), "");
  }
}

}  // namespace
}  // namespace metamer::client
