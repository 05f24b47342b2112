#pragma once
// The pages of the lab panel, one for each lesson.

#include "app/lab/lab_inputs.h"
#include "app/platform/task_thread.h"
#include "app/ui/widgets.h"

#include <memory>

namespace candela {

/// A page draws itself with Ui into the current ImGui window. Its lessons advance only in step().
class LabPage {
public:
  virtual ~LabPage() = default;
  /// `sampler` holds the sampler's settings, which all pages share.
  virtual void draw(Ui& ui, Document& sampler) = 0;
  virtual void step(TaskThread& worker) = 0;
  virtual bool busy() const = 0; ///< whether step() has work to do
};

std::unique_ptr<LabPage> make_pi_page();
std::unique_ptr<LabPage> make_solid_angle_page();
std::unique_ptr<LabPage> make_integral_page();
std::unique_ptr<LabPage> make_points_page();
std::unique_ptr<LabPage> make_warps_page();
std::unique_ptr<LabPage> make_brdf_page();
std::unique_ptr<LabPage> make_medium_page();
std::unique_ptr<LabPage> make_lens_page();

/// A row of a field table as a widget named "lab." and the key, labelled by the key's last part unless
/// `label` is given.
template <class Owner>
bool lab_field(Ui& ui, const Field<Owner>& row, Owner& owner, const Owner& initial,
               std::string_view label = {}) {
  FieldInfo info = row;
  info.invalidates = Invalidates::nothing; // editing it does not affect the picture
  FieldContext context;
  context.initial = row.address(const_cast<Owner&>(initial));
  context.label = label;
  return ui.field("lab." + std::string(row.key), info, row.address(owner), context);
}

/// The sampler's rows; strata only for the stratified sampler.
void sampler_fields(Ui& ui, Document& sampler);
/// The samplers' names, in SamplerType's order.
std::span<const std::string_view> sampler_names();

} // namespace candela
