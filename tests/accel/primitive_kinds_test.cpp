// The list of primitive kinds, and their child references with limits.

#include "accel/accel.h"
#include "accel/wide_bvh.h"
#include "core/error.h"

#include <gtest/gtest.h>

namespace {

using namespace candela;
using namespace candela::accel_detail;

TEST(PrimitiveKinds, EachIsVisitedByItsNumber) {
  std::size_t next = 0;
  PrimitiveKinds::for_each([&]<class Kind>() {
    const auto kind = static_cast<PrimitiveKind>(next++);
    EXPECT_EQ(PrimitiveKinds::kind_of<Kind>, kind);
    bool same = false;
    EXPECT_TRUE(
        PrimitiveKinds::visit(kind, [&]<class Visited>() { return same = std::is_same_v<Visited, Kind>; }));
    EXPECT_TRUE(same);
  });
  EXPECT_EQ(next, PrimitiveKinds::kCount);
  EXPECT_FALSE(PrimitiveKinds::visit(static_cast<PrimitiveKind>(next), []<class Kind>() { return true; }));
}

TEST(ChildRef, HoldsSixteenKindsAndAllIndicesBelowTheirLimits) {
  for (std::uint32_t kind = 0; kind < 16; ++kind)
    for (std::uint32_t pack : {0u, 1u, 0x5555555u, ChildRef::kMaxPacks - 1}) {
      const ChildRef leaf = ChildRef::leaf(static_cast<PrimitiveKind>(kind), pack);
      EXPECT_TRUE(leaf.is_leaf());
      EXPECT_EQ(static_cast<std::uint32_t>(leaf.kind()), kind);
      EXPECT_EQ(leaf.pack(), pack);
    }
  for (std::uint32_t node : {0u, 1u, 0x7fffffffu}) {
    EXPECT_FALSE(ChildRef::node(node).is_leaf());
    EXPECT_EQ(ChildRef::node(node).node(), node);
  }
}

TEST(ChildRef, MorePacksOfAKindThanItCanNameAreRefused) {
  PerKind<std::uint32_t> packs{};
  packs.fill(ChildRef::kMaxPacks);
  EXPECT_NO_THROW(require_addressable(packs));
  for (std::size_t kind = 0; kind < packs.size(); ++kind) {
    PerKind<std::uint32_t> more{};
    more[kind] = ChildRef::kMaxPacks + 1;
    try {
      require_addressable(more);
      ADD_FAILURE() << kind;
    } catch (const Error& error) { EXPECT_EQ(error.code(), ExitCode::limit); }
  }
}

} // namespace
