#include "libguide/base/nearest_name.h"

#include <gtest/gtest.h>

namespace waylight {
namespace {

TEST(NearestName, IsThatOfTheFewestSlips) {
  const std::vector<std::string> known = {"box", "tent", "gaussian", "mitchell"};
  const auto nearest = [&](const std::string& unknown) {
    const std::string* name = nearest_name(unknown, known);
    return name ? *name : "";
  };
  EXPECT_EQ(nearest("bx"), "box");
  EXPECT_EQ(nearest("tnet"), "tent");
  EXPECT_EQ(nearest("gausian"), "gaussian");
  EXPECT_EQ(nearest("lanczos"), "");
  EXPECT_EQ(nearest(std::string(1000, 'x')), "");
}

}  // namespace
}  // namespace waylight
