#include "core/recycler.h"

#include <gtest/gtest.h>

namespace candela {
namespace {

TEST(Recycler, GivesOutAgainWhatNobodyHolds) {
  Recycler<std::vector<int>> vectors;
  auto first = vectors.take();
  first->assign(100, 7);
  const int* memory = first->data();
  auto second = vectors.take();
  EXPECT_NE(second, first) << "the first is still looked at";
  const auto shared = first;
  first.reset();
  EXPECT_NE(vectors.take()->data(), memory) << "somebody shares it";
}

TEST(Recycler, KeepsTheMemory) {
  Recycler<std::vector<int>> vectors;
  auto held = vectors.take();
  held->assign(100, 7);
  const int* memory = held->data();
  held.reset();
  EXPECT_EQ(vectors.take()->data(), memory);
}

TEST(Recycler, MayEndBeforeWhatItGave) {
  std::shared_ptr<std::vector<int>> held;
  {
    Recycler<std::vector<int>> vectors;
    held = vectors.take();
  }
  held->assign(3, 1);
  EXPECT_EQ(held->size(), 3u);
}

} // namespace
} // namespace candela
