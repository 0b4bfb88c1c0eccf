#include "tenon/base/fingerprint.h"

#include <gtest/gtest.h>

namespace tenon {
namespace {

// Published test vectors of FNV-1a, 64 bits.
TEST(Fingerprint, IsFnv1a) {
  EXPECT_EQ(Fingerprint().text(), "cbf29ce484222325");
  Fingerprint a, word;
  a.add("a");
  EXPECT_EQ(a.text(), "af63dc4c8601ec8c");
  word.add("foo");
  word.add("bar");
  EXPECT_EQ(word.text(), "85944171f73967e8");
}

}  // namespace
}  // namespace tenon
