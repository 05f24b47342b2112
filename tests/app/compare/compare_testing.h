#pragma once
// A comparison under a driven window.

#include "app/harness.h"

namespace candela::test {

inline Document noisy_document(int spp) {
  Document document = test_document();
  document.settings.stop.spp = spp;
  return document;
}

inline const CompareState& compare(const ViewerHarness& hand) { return hand.state().compare; }

inline void wait_for_both(ViewerHarness& hand) {
  hand.wait_until("both variants are finished", [&] {
    const auto& variants = compare(hand).variants;
    return variants[0].status.phase == SessionPhase::finished &&
           variants[1].status.phase == SessionPhase::finished;
  });
  hand.viewer.session().wait_finished(ViewerHarness::kPatience);
  hand.viewer.comparison().other_session()->wait_finished(ViewerHarness::kPatience);
  hand.frame(3, 11); // past the hints
}

/// Begins a comparison in which B has independent samples.
inline void begin(ViewerHarness& hand) {
  hand.key(Key::c);
  hand.frame(3);
  ASSERT_TRUE(compare(hand).active);
  hand.unfold("panel.render", "group.sampler");
  hand.unfold("group.sampler", "sampler.type");
  hand.choose("sampler.type", "independent");
}

} // namespace candela::test
