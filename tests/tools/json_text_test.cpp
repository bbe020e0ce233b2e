// File names are bytes, JSON is UTF-8.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tools/common/cli.h"

namespace waylight {
namespace {

TEST(JsonText, BytesThatAreNoUtf8AreReplaced) {
  const std::string text = json_text({{"file",
                                       "r\xff"
                                       "om.cache"},
                                      {"name", "f\xc3\xbcr"}});
  EXPECT_EQ(text, "{\n  \"file\": \"r\xef\xbf\xbdom.cache\",\n  \"name\": \"f\xc3\xbcr\"\n}");
}

}  // namespace
}  // namespace waylight
