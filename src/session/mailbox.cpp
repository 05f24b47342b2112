#include "session/mailbox.h"

#include <utility>

namespace candela {

Mailbox::Receipt Mailbox::submit(Locked, Document document) {
  const Invalidates consequence = submitted_ == 0 ? Invalidates::scene : compare_documents(newest_, document);
  const bool same_groups = newest_.scene.light_groups == document.scene.light_groups;
  newest_ = document;
  pending_ = std::move(document);
  consequence_ = std::max(consequence_, consequence);
  Receipt receipt{++submitted_, consequence >= Invalidates::image};
  receipt.remixes = !receipt.restarts && !same_groups;
  if (receipt.remixes) hold_ = true;
  if (receipt.restarts) {
    submitted_at_ = Clock::now();
    restarting_ = receipt.generation;
    outdated_ = true;
  }
  return receipt;
}

void Mailbox::pause(Locked, bool paused) {
  paused_ = paused;
  steps_wanted_ = 0;
  if (paused) hold_ = true;
}

void Mailbox::step(Locked) {
  paused_ = true;
  ++steps_wanted_;
}

void Mailbox::set_region(Locked, const CropWindow& region) {
  region_ = region;
  region_changed_ = true;
  hold_ = true;
}

void Mailbox::close(Locked) {
  closing_ = true;
  outdated_ = true;
}

std::optional<Mailbox::Delivery> Mailbox::take(Locked) {
  if (!pending_) return std::nullopt;
  outdated_ = false;
  Delivery delivery{std::move(*pending_), std::exchange(consequence_, Invalidates::nothing), submitted_,
                    submitted_at_};
  pending_.reset();
  return delivery;
}

std::optional<CropWindow> Mailbox::take_region(Locked) {
  if (!std::exchange(region_changed_, false)) return std::nullopt;
  return region_;
}

bool Mailbox::take_step(Locked) {
  if (steps_wanted_ == 0) return false;
  --steps_wanted_;
  return true;
}

} // namespace candela
