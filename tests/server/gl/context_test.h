#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>

#include "server/gl/context.h"

namespace metamer::gl {

/// Tests that draw: one context is current for all of them.
class ContextTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    setenv("MESA_SHADER_CACHE_DISABLE", "1", 1);  // Or the cache lands in $HOME.
    auto created = Context::create();
    ASSERT_TRUE(created) << created.error().message << ": see deploy/dependencies";
    context_ = std::make_unique<Context>(std::move(*created));
  }
  static void TearDownTestSuite() { context_.reset(); }

 private:
  static inline std::unique_ptr<Context> context_;
};

}  // namespace metamer::gl
