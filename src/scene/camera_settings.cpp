#include "scene/camera_settings.h"

namespace candela {

namespace {

constexpr auto kInf = std::numeric_limits<double>::infinity();
constexpr std::string_view kProjections[] = {"perspective", "orthographic", "spherical"};
constexpr std::string_view kStereo[] = {"none", "side_by_side", "top_bottom"};
constexpr std::string_view kLenses[] = {"thin", "double_gauss", "wide_angle", "telephoto", "fisheye"};

constexpr auto kImage = Invalidates::image;

#define AT(member) [](Document& d) -> void* { return &d.member; }

const Field<Document> kRows[] = {
    {{"camera.position", FieldType::point, -kInf, kInf, "", "Position of the camera"},
     AT(scene.camera.position)},
    {{"camera.target", FieldType::point, -kInf, kInf, "", "The point it looks at"}, AT(scene.camera.target)},
    {{"camera.up", FieldType::point, -kInf, kInf, "", "The direction that is up in the image"},
     AT(scene.camera.up)},
    {{"camera.vertical_fov", FieldType::angle, 0.1, 179, "degrees", "Vertical field of view"},
     AT(scene.camera.vertical_fov)},
    {{"camera.shutter_open", FieldType::real, 0, 1, "",
      "Time at which the shutter opens; what moves does so from time 0 to time 1"},
     AT(scene.camera.shutter_open)},
    {{"camera.shutter_close", FieldType::real, 0, 1, "",
      "Time at which the shutter closes; that of its opening: an instant, without motion blur"},
     AT(scene.camera.shutter_close)},
    {{"camera.motion_position", FieldType::point, -kInf, kInf, "", "Way of the camera by time 1"},
     AT(scene.camera.motion_position)},
    {{"camera.motion_target", FieldType::point, -kInf, kInf, "",
      "Way, by time 1, of the point it looks at; as that of the position to keep the direction"},
     AT(scene.camera.motion_target)},
    {{"camera.motion_up", FieldType::point, -kInf, kInf, "", "Change of the up direction by time 1"},
     AT(scene.camera.motion_up)},
    {{"camera.motion_fov", FieldType::angle, -178, 178, "degrees",
      "Change of the vertical field of view by time 1, of a perspective view through a thin lens; it stays "
      "within 0.1 and 179"},
     AT(scene.camera.motion_fov)},
    {{"camera.projection", FieldType::choice, 0, 0, "",
      "Perspective, parallel rays, or all directions (360 degrees, equirectangular)", kImage, kProjections},
     AT(scene.camera.projection)},
    {{"camera.orthographic_height",
      FieldType::real,
      1e-6,
      Camera::kGreatestHeight,
      "scene units",
      "Height of the orthographic view",
      kImage,
      {},
      true},
     AT(scene.camera.orthographic_height)},
    {{"camera.aspect", FieldType::real, 0, 100, "",
      "Width over height of the view, independent of its pixels; 0: square pixels"},
     AT(scene.camera.aspect)},
    {{"camera.aperture_radius",
      FieldType::real,
      0,
      1e6,
      "scene units",
      "Radius of the thin lens; 0 is a pinhole, everything is in focus",
      kImage,
      {},
      true},
     AT(scene.camera.aperture_radius)},
    {{"camera.focus_distance",
      FieldType::real,
      0,
      1e9,
      "scene units",
      "Distance of the plane in focus along the view axis; 0: that of the target",
      kImage,
      {},
      true},
     AT(scene.camera.focus_distance)},

    {{"camera.lens", FieldType::choice, 0, 0, "",
      "A thin lens, or a published one that rays go through element by element: its field of view follows "
      "from the "
      "sensor",
      kImage, kLenses},
     AT(scene.camera.lens)},
    {{"camera.f_stop",
      FieldType::real,
      0,
      128,
      "",
      "Of a lens of elements: focal length over the diameter of its pupil; 0: wide open",
      kImage,
      {},
      true},
     AT(scene.camera.f_stop)},
    {{"camera.sensor_diagonal",
      FieldType::real,
      1,
      500,
      "mm",
      "Diagonal of the film behind a lens of elements",
      kImage,
      {},
      true},
     AT(scene.camera.sensor_diagonal)},
    {{"camera.units_per_mm",
      FieldType::real,
      1e-6,
      1e3,
      "scene units",
      "Length of a millimetre of a lens of elements; 0.001 in a scene in metres",
      kImage,
      {},
      true},
     AT(scene.camera.units_per_mm)},
    {{"camera.blades", FieldType::integer, 0, 16, "", "Blades of the aperture; below 3 it is round"},
     AT(scene.camera.blades)},
    {{"camera.blade_rotation", FieldType::angle, -360, 360, "degrees", "Turn of the aperture's blades"},
     AT(scene.camera.blade_rotation)},
    {{"camera.stereo", FieldType::choice, 0, 0, "",
      "A picture for each eye, in halves of the film: the left eye's on the left, or on top", kImage,
      kStereo},
     AT(scene.camera.stereo)},
    {{"camera.interocular_distance",
      FieldType::real,
      0,
      1e6,
      "scene units",
      "Distance between the eyes; 0.065 in a scene in metres",
      kImage,
      {},
      true},
     AT(scene.camera.interocular_distance)},
    {{"camera.convergence_distance",
      FieldType::real,
      0,
      1e9,
      "scene units",
      "Distance at which both eyes' pictures coincide, as on the screen that shows them; 0: at infinity, "
      "the eyes look in parallel",
      kImage,
      {},
      true},
     AT(scene.camera.convergence_distance)},
};

#undef AT

} // namespace

std::span<const Field<Document>> camera_rows() { return kRows; }

} // namespace candela
