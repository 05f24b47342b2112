#include "materials/material_parts.h"

#include "materials/blend_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace candela {

namespace {

/// A walk into the parts of parts, with a stack of its own: files may nest them as deeply as they like.
class PartsCheck {
public:
  explicit PartsCheck(std::span<const Material> materials)
      : materials_(materials), states_(materials.size()) {}

  std::optional<PartsProblem> run() {
    for (std::size_t i = 0; i < materials_.size() && !problem_; ++i)
      if (states_[i].progress == Progress::unseen) visit(i);
    return std::move(problem_);
  }

private:
  enum class Progress { unseen, open, done };
  struct State {
    Progress progress = Progress::unseen;
    int nesting = 0;        ///< combined materials in it, one in the other, itself included
    std::size_t leaves = 1; ///< materials that a blend of it mixes
  };
  struct Part {
    std::string_view key;
    int index;
  };
  struct Step {
    std::size_t material;
    std::vector<Part> parts;
    std::size_t next = 0;
  };

  void open(std::size_t material) {
    states_[material].progress = Progress::open;
    Step& step = way_.emplace_back(Step{material, {}, 0});
    each_part(materials_[material], [&](const MaterialField& row, int index) {
      step.parts.push_back({row.key, index});
    });
  }

  void visit(std::size_t first) {
    open(first);
    while (!way_.empty() && !problem_) {
      Step& step = way_.back();
      if (step.next == step.parts.size()) {
        close(step);
        way_.pop_back();
        continue;
      }
      const Part part = step.parts[step.next++];
      if (part.index == -1) continue;
      if (part.index < 0 || static_cast<std::size_t>(part.index) >= materials_.size()) {
        refuse(step, part.key, fmt::format("there is no material {}", part.index), "name one of the scene's");
        continue;
      }
      const auto index = static_cast<std::size_t>(part.index);
      if (is_null(materials_[index]))
        refuse(step, part.key, fmt::format("'{}' is invisible (null)", name(index)),
               "give this material an opacity instead");
      else if (states_[index].progress == Progress::open)
        refuse(step, part.key, fmt::format("the materials contain themselves: {}", cycle(index)),
               "name another one");
      else if (states_[index].progress == Progress::unseen)
        open(index); // `step` is invalid now
    }
  }

  void close(const Step& step) {
    State& state = states_[step.material];
    state.progress = Progress::done;
    if (step.parts.empty()) return;
    const bool mixes = std::holds_alternative<BlendMaterial>(materials_[step.material].model);
    std::size_t leaves = 0;
    for (const Part& part : step.parts) {
      const State known = part.index < 0 ? State() : states_[static_cast<std::size_t>(part.index)];
      state.nesting = std::max(state.nesting, known.nesting + 1);
      leaves = mixes ? leaves + known.leaves : std::max(leaves, known.leaves);
      if (leaves > kMostBlendParts)
        return refuse(step, part.key, fmt::format("more than {} materials are blended", kMostBlendParts),
                      "use fewer");
      if (state.nesting > kMostNesting)
        return refuse(step, part.key,
                      fmt::format("more than {} combined materials contain each other", kMostNesting),
                      "use fewer");
    }
    state.leaves = leaves;
  }

  void refuse(const Step& step, std::string_view key, std::string cause, std::string remedy) {
    problem_ = PartsProblem{step.material, key, std::move(cause), std::move(remedy)};
  }

  std::string name(std::size_t index) const {
    constexpr std::size_t kLongest = 60;
    const std::string& own = materials_[index].name;
    return own.empty() ? fmt::format("material {}", index) : own.substr(0, kLongest);
  }
  /// "a -> b -> a", of at most so many names.
  std::string cycle(std::size_t from) const {
    constexpr std::ptrdiff_t kShown = 8;
    const auto begin = std::ranges::find(way_, from, &Step::material);
    std::string text;
    for (auto step = begin; step != way_.end() && step - begin < kShown; ++step)
      text += name(step->material) + " -> ";
    return text + (way_.end() - begin > kShown ? "... -> " : "") + name(from);
  }

  std::span<const Material> materials_;
  std::vector<State> states_;
  std::vector<Step> way_;
  std::optional<PartsProblem> problem_;
};

} // namespace

bool contains_material(std::span<const Material> materials, int whole, int part) {
  if (whole == part) return true;
  if (whole < 0) return false;
  bool found = false;
  each_part(materials[static_cast<std::size_t>(whole)], [&](const MaterialField&, int index) {
    found |= index >= 0 && contains_material(materials, index, part);
  });
  return found;
}

std::optional<PartsProblem> parts_problem(std::span<const Material> materials) {
  return PartsCheck(materials).run();
}

std::optional<Interior> interior(std::span<const Material* const> materials, std::size_t i) {
  std::optional<Interior> found = interior(materials[i]->model);
  each_part(*materials[i], [&](const MaterialField&, int index) {
    if (!found && index >= 0) found = interior(materials, static_cast<std::size_t>(index));
  });
  if (!materials[i]->medium.empty()) {
    if (!found) found = Interior{};
    found->medium = materials[i]->medium;
    found->matter.reset();
  }
  return found;
}

} // namespace candela
