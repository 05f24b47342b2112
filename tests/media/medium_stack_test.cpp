#include "media/medium_stack.h"

#include <gtest/gtest.h>

namespace candela::test {
namespace {

MediumId medium(int index, int priority = 0) {
  return {static_cast<std::uint16_t>(index), static_cast<std::int16_t>(priority)};
}

TEST(MediumStack, OfEqualPriorityTheLastEnteredFillsThePoint) {
  MediumStack in;
  EXPECT_FALSE(in.current());
  in.enter(medium(3));
  in.enter(medium(5));
  EXPECT_EQ(in.current(), medium(5));
  in.leave(medium(3)); // the other one first: they overlap
  EXPECT_EQ(in.current(), medium(5));
  in.leave(medium(4)); // was never entered
  EXPECT_EQ(in.current(), medium(5));
  in.leave(medium(5));
  EXPECT_TRUE(in.empty());
  EXPECT_FALSE(in.current());
  in.enter(MediumId());
  EXPECT_TRUE(in.empty());
}

TEST(MediumStack, TheHighestPriorityFillsThePointInWhateverOrder) {
  // A glass (2) that holds water (1), both closed bodies that overlap a little; an ice cube (3) across both.
  MediumStack in;
  in.enter(medium(0, 2));
  EXPECT_EQ(in.current(), medium(0, 2));
  in.enter(medium(1, 1)); // still within the glass's wall
  EXPECT_EQ(in.current(), medium(0, 2));
  in.leave(medium(0, 2)); // through the wall's inner side
  EXPECT_EQ(in.current(), medium(1, 1));
  in.enter(medium(7, 3));
  in.enter(medium(0, 2));
  EXPECT_EQ(in.current(), medium(7, 3));
  in.leave(medium(7, 3));
  EXPECT_EQ(in.current(), medium(0, 2));
  in.leave(medium(1, 1));
  in.leave(medium(0, 2));
  EXPECT_TRUE(in.empty());
}

TEST(MediumStack, SurfacesInsideOfHigherBodiesAreHidden) {
  const MediumInterface water{medium(1, 1), {}}, glass{medium(0, 2), {}}, plain{medium(5), {}};
  MediumStack in;
  EXPECT_FALSE(in.hides(water, true));
  in.cross(glass, true);
  EXPECT_TRUE(in.hides(water, true));
  EXPECT_FALSE(in.hides(glass, false));
  EXPECT_FALSE(in.hides(glass, true)); // another of the same
  EXPECT_FALSE(in.hides(plain, true)) << "no priority: is always there";
  in.cross(water, true);
  EXPECT_TRUE(in.hides(water, false));
  EXPECT_FALSE(in.hides(glass, false));
  in.cross(glass, false);
  EXPECT_FALSE(in.hides(water, false));
  EXPECT_FALSE(in.hides(glass, true));
  in.cross(water, false);
  EXPECT_FALSE(in.hides(glass, false)) << "left without having been entered";
}

TEST(MediumStack, WhatLiesOutsideOfASurface) {
  const MediumInterface water{medium(1, 1), {}}, glass{medium(0, 2), {}};
  MediumStack in;
  EXPECT_FALSE(in.outside_of(water, true));
  in.cross(water, true);
  EXPECT_FALSE(in.outside_of(water, false));
  EXPECT_EQ(in.outside_of(glass, true), medium(1, 1));
  in.cross(glass, true);
  EXPECT_EQ(in.outside_of(glass, false), medium(1, 1));
  in.cross(water, false);
  EXPECT_FALSE(in.outside_of(glass, false));
}

TEST(MediumStack, OfEqualPriorityTheFirstEnteredIsHiddenInTheOther) {
  const MediumInterface a{medium(1, 1), {}}, b{medium(2, 1), {}};
  MediumStack in;
  in.cross(a, true);
  EXPECT_FALSE(in.hides(b, true));
  in.cross(b, true);
  EXPECT_TRUE(in.hides(a, false));
  EXPECT_FALSE(in.hides(b, false));
}

TEST(MediumStack, EqualMediaOfDifferentPriorityAreDifferentBodies) {
  MediumStack in;
  in.enter(medium(4, 1));
  in.enter(medium(4, 2));
  in.leave(medium(4, 2));
  EXPECT_EQ(in.current(), medium(4, 1));
}

TEST(MediumStack, AnEighthBodyMakesItForgetTheFirst) {
  MediumStack in;
  for (int i = 0; i < 100; ++i) in.enter(medium(i));
  for (int i = 99; i > 92; --i) {
    EXPECT_EQ(in.current(), medium(i));
    in.leave(medium(i));
  }
  EXPECT_TRUE(in.empty());
}

TEST(MediumStack, SurfacesExchangeTheMediaOfTheirSides) {
  const MediumInterface ball{medium(1), {}}, waterline{medium(2), medium(3)};
  MediumStack in;
  in.cross(ball, true);
  EXPECT_EQ(in.current(), medium(1));
  in.cross(ball, false);
  EXPECT_TRUE(in.empty());
  in.enter(medium(3));
  in.cross(waterline, true);
  EXPECT_EQ(in.current(), medium(2));
  in.cross(waterline, false);
  EXPECT_EQ(in.current(), medium(3));
  in.cross(MediumInterface(), true); // a wall
  EXPECT_EQ(in.current(), medium(3));
}

} // namespace
} // namespace candela::test
