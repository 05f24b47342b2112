#pragma once
// Changes of a scene's media that materials and the scene refer to by name.

#include "scene/scene_desc.h"

namespace candela {

/// Media to begin with, by what they are: "fog", "smoke", "milk" ….
std::vector<MediumDesc> medium_presets();

/// Adds a medium of the values of a file, which fills the scene, and its index. Its box has the proportions
/// of the file's and is as large as fits into `within`; into [-1, 1]^3 where that is empty.
std::size_t add_grid_medium(SceneDesc& scene, std::shared_ptr<const VolumeGrid> grid, const Bounds3& within);
/// Puts the medium, if it has the values of a file, into the box that the file tells of.
void take_box_of_file(MediumDesc& medium);

/// Adds a medium, under a name of its own if there is one of that name. Its index.
std::size_t add_medium(SceneDesc& scene, MediumDesc medium);
/// Nothing refers to it any more.
void remove_medium(SceneDesc& scene, std::size_t index);
/// What referred to it still does. False, and nothing changes, where the name is empty or another's.
bool rename_medium(SceneDesc& scene, std::size_t index, const std::string& name);

/// Fills an object: its materials bound the medium of that name (empty: none). Materials that other objects
/// have, too, are copied first. False if light enters none of its surfaces, so that nothing of it can be
/// seen.
bool fill_instance(SceneDesc& scene, std::size_t instance, const std::string& medium);

/// Whether light enters bodies of the material: those of it that are made of others are asked in turn.
bool lets_light_in(const SceneDesc& scene, const Material& material);

} // namespace candela
