#pragma once
// The pages of the lab panel, one for each lesson.

#include "app/lab/lab_inputs.h"
#include "app/platform/task_thread.h"
#include "app/ui/widgets.h"

#include <memory>

namespace candela {

/// Draws itself with Ui into the current ImGui window. Its lessons advance only while it is stepped.
class LabPage {
public:
  virtual ~LabPage() = default;
  /// `sampler` holds the sampler's settings, which all pages share.
  virtual void draw(Ui& ui, Document& sampler) = 0;
  virtual void step(TaskThread& worker) = 0;
  virtual bool busy() const = 0; ///< whether step() would have something to do
};

std::unique_ptr<LabPage> make_pi_page();
std::unique_ptr<LabPage> make_solid_angle_page();
std::unique_ptr<LabPage> make_integral_page();
std::unique_ptr<LabPage> make_points_page();
std::unique_ptr<LabPage> make_warps_page();
std::unique_ptr<LabPage> make_brdf_page();

/// A row of a field table among the lab's widgets, named "lab." and its key; labelled by the key's last
/// part unless there is a label.
template <class Owner>
bool lab_field(Ui& ui, const Field<Owner>& row, Owner& owner, const Owner& initial,
               std::string_view label = {}) {
  FieldInfo info = row;
  info.invalidates = Invalidates::nothing; // of the picture
  FieldContext context;
  context.initial = row.address(const_cast<Owner&>(initial));
  context.label = label;
  return ui.field("lab." + std::string(row.key), info, row.address(owner), context);
}

/// The sampler's rows; strata only where that is of use.
void sampler_fields(Ui& ui, Document& sampler);
/// In SamplerType's order.
std::span<const std::string_view> sampler_names();

} // namespace candela
