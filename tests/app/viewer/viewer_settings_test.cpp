// Every setting through its widget, and what it restarts.

#include "app/harness.h"
#include "support/materials.h"

#include <fmt/format.h>

namespace candela::test {
namespace {

/// The widget of a row, and of a vector's first component.
std::string widget_of(const FieldInfo& row, const std::string& name) {
  if (row.type == FieldType::point) return name + ".x";
  if (row.type == FieldType::color) return name + ".r";
  return name;
}

/// Another value of the row: what to type or choose, and how the row's value reads afterwards.
struct Edit {
  std::string typed;
  std::string text;
};

Edit other_value(const FieldInfo& row, void* address) {
  alignas(vec3) unsigned char storage[sizeof(vec3)] = {};
  field_copy(row, storage, address);
  switch (row.type) {
  case FieldType::boolean: {
    bool& value = *static_cast<bool*>(static_cast<void*>(storage));
    value = !value;
    return {"", field_to_text(row, storage)};
  }
  case FieldType::choice: {
    const std::string now = field_to_text(row, address);
    const std::string_view next = row.choices[0] == now ? row.choices[1] : row.choices[0];
    return {std::string(next), std::string(next)};
  }
  case FieldType::material: return {"white", "0"}; // the first of the Cornell box
  case FieldType::integer: {
    int& value = *static_cast<int*>(static_cast<void*>(storage));
    value += value + 1 <= row.maximum ? 1 : -1;
    return {field_to_text(row, storage), field_to_text(row, storage)};
  }
  case FieldType::real:
  case FieldType::angle: {
    const double unit = row.type == FieldType::angle ? 180 / std::numbers::pi : 1;
    const double now = static_cast<double>(*static_cast<float*>(static_cast<void*>(storage))) * unit;
    const double next = now + 0.25 <= row.maximum ? now + 0.25 : now - 0.25;
    const std::string typed = fmt::format("{:.4g}", next);
    field_from_text(row, storage, typed);
    return {typed, field_to_text(row, storage)};
  }
  case FieldType::point:
  case FieldType::color: {
    vec3& value = *static_cast<vec3*>(static_cast<void*>(storage));
    value.x = std::round(4 * (value.x + (value.x + 0.25 <= row.maximum ? 0.25f : -0.25f))) / 4;
    return {fmt::format("{}", value.x), field_to_text(row, storage)};
  }
  }
  return {};
}

void edit(ViewerHarness& hand, const FieldInfo& row, const std::string& name, const Edit& value) {
  if (row.type == FieldType::choice || row.type == FieldType::material)
    hand.choose(name, value.typed);
  else if (row.type == FieldType::boolean)
    hand.click(name);
  else
    hand.type_into(widget_of(row, name), value.typed);
  hand.frame(2);
}

std::uint64_t restarts(ViewerHarness& hand) {
  hand.wait_for_picture();
  return hand.viewer.session().status().restarts;
}

std::uint64_t expected_restarts(Invalidates invalidates) { return invalidates >= Invalidates::image ? 1 : 0; }

/// Overrides the materials by one that has the value, for its row to appear; by none for other rows.
void show_row(ViewerHarness& hand, const Field<Document>& row) {
  if (!row.key.starts_with("override.")) return;
  std::string chosen = "none";
  for (int type = 0; type < kMaterialTypeCount && row.key != "override.brdf"; ++type) {
    const MaterialField* value = find_material_field(type, row.key.substr(9));
    if (value == nullptr || !value->kept) continue;
    chosen = material_type_names()[static_cast<std::size_t>(type)];
    break;
  }
  if (field_text(*find_setting("override.brdf"), hand.document()) != chosen)
    hand.choose("override.brdf", chosen);
}

TEST(ViewerSettingsUi, EveryRowOfTheTableRestartsAsItSays) {
  ViewerHarness hand;
  hand.unfold_all();
  std::uint64_t before = restarts(hand);
  for (const auto& row : settings_table()) {
    SCOPED_TRACE(row.key);
    show_row(hand, row);
    before = restarts(hand);
    Document document = hand.document();
    const std::string old = field_text(row, document);
    const Edit value = other_value(row, row.address(document));
    edit(hand, row, std::string(row.key), value);
    EXPECT_NE(value.text, old);
    EXPECT_EQ(field_text(row, hand.document()), value.text);
    std::uint64_t after = restarts(hand);
    EXPECT_EQ(after - before, expected_restarts(row.invalidates));
    before = after;
    // Restored, so that no pair of values makes the next row's edit ineffective.
    field_from_text(row, row.address(document), old);
    const Edit back{row.type == FieldType::point || row.type == FieldType::color
                        ? fmt::format("{}", static_cast<vec3*>(row.address(document))->x)
                        : old,
                    old};
    edit(hand, row, std::string(row.key), back);
    EXPECT_EQ(field_text(row, hand.document()), old);
    after = restarts(hand);
    EXPECT_EQ(after - before, expected_restarts(row.invalidates));
    before = after;
  }
}

TEST(ViewerSettingsUi, DoubleClickResetsEveryRow) {
  ViewerHarness hand;
  hand.unfold_all();
  const Document defaults;
  for (const auto& row : settings_table()) {
    if (row.type == FieldType::boolean || row.type == FieldType::choice)
      continue; // their names do, see below
    SCOPED_TRACE(row.key);
    show_row(hand, row);
    Document document = hand.document();
    edit(hand, row, std::string(row.key), other_value(row, row.address(document)));
    hand.double_click(widget_of(row, std::string(row.key)));
    hand.frame(2);
    const Document& initial = row.key.starts_with("camera.") ? hand.state().home : defaults;
    EXPECT_EQ(field_text(row, hand.document()), field_text(row, initial));
  }
}

TEST(ViewerSettingsUi, DoubleClickOnTheNameResetsAChoice) {
  ViewerHarness hand;
  hand.choose("display.tone_map", "filmic");
  ASSERT_EQ(hand.document().settings.display.tone_map, ToneMap::filmic);
  hand.double_click("display.tone_map#label");
  EXPECT_EQ(hand.document().settings.display.tone_map, DisplaySettings{}.tone_map);
}

TEST(ViewerSettingsUi, TypingCountsWhenItIsDone) {
  ViewerHarness hand;
  hand.unfold_all();
  const std::uint64_t before = restarts(hand);
  hand.begin_typing("film.width");
  hand.type("123");
  EXPECT_EQ(hand.document().settings.film.width, 64) << "half a number was taken for one";
  hand.key(Key::enter);
  hand.frame(2);
  EXPECT_EQ(hand.document().settings.film.width, 123);
  EXPECT_EQ(restarts(hand) - before, 1u);
  // A click elsewhere is like Enter.
  hand.begin_typing("film.width");
  hand.type("77");
  hand.click(hand.reveal("statistics.progress"));
  EXPECT_EQ(hand.document().settings.film.width, 77);
}

TEST(ViewerSettingsUi, EscapeTakesTypingBack) {
  ViewerHarness hand;
  hand.begin_typing("display.exposure");
  hand.type("7");
  hand.key(Key::escape);
  hand.frame(2);
  EXPECT_EQ(hand.document().settings.display.exposure, 0.0f);
}

TEST(ViewerSettingsUi, TypedValuesStayInTheirRow) {
  ViewerHarness hand;
  hand.unfold_all();
  hand.type_into("film.width", "0");
  EXPECT_EQ(hand.document().settings.film.width, 1);
  hand.type_into("path.max_depth", "-7");
  EXPECT_EQ(hand.document().settings.path.max_depth, -1);
  hand.type_into("display.exposure", "1e30");
  EXPECT_EQ(hand.document().settings.display.exposure, 20.0f);
  hand.type_into("camera.position.x", "1e39"); // not a float
  EXPECT_EQ(hand.document().scene.camera.position.x, 0.0f);
  hand.type_into("camera.aperture_radius", "123456"); // beyond its slider, within its row
  EXPECT_EQ(hand.document().scene.camera.aperture_radius, 123456.0f);
  EXPECT_EQ(document_problem(hand.document()), "");
}

TEST(ViewerSettingsUi, ASliderIsDragged) {
  ViewerHarness hand;
  const auto slider = hand.find("display.exposure");
  ASSERT_TRUE(slider);
  const float y = 0.5f * (slider->lo.y + slider->hi.y);
  const std::uint64_t before = restarts(hand);
  hand.drag({0.5f * (slider->lo.x + slider->hi.x), y}, {slider->hi.x - 30, y});
  EXPECT_GT(hand.document().settings.display.exposure, 5.0f);
  EXPECT_LT(hand.document().settings.display.exposure, 20.0f);
  EXPECT_EQ(restarts(hand), before);
}

TEST(ViewerSettingsUi, ExposureChangesThePictureOnly) {
  ViewerHarness hand;
  hand.wait_for_picture();
  const auto frame_before = hand.viewer.viewport().shown()->frame;
  hand.type_into("display.exposure", "2");
  hand.wait_for_picture();
  const auto shown = hand.viewer.viewport().shown();
  EXPECT_EQ(shown->frame, frame_before) << "the same samples";
  EXPECT_EQ(shown->display.exposure, 2.0f);
}

TEST(ViewerSettingsUi, ACameraThatLooksNowhereIsRefused) {
  ViewerHarness hand;
  hand.unfold_all();
  const Camera before = hand.document().scene.camera;
  hand.type_into("camera.position.z", "0"); // where the target is
  EXPECT_EQ(hand.document().scene.camera, before);
  EXPECT_NE(hand.state().error, "");
}

TEST(ViewerSettingsUi, EveryMaterialFieldOfEveryType) {
  ViewerHarness hand;
  hand.unfold_all();
  hand.click("materials/1");
  ASSERT_EQ(hand.state().selected_material, 1);
  std::uint64_t before = restarts(hand);
  std::set<std::string_view> keys;
  for (int type = 0; type < kMaterialTypeCount; ++type)
    for (const auto& row : material_fields(type)) keys.insert(row.key);
  for (std::string_view type : material_type_names()) {
    if (material_type_name(hand.document().scene.materials[1]) != type) {
      hand.choose("material.type", std::string(type));
      before = restarts(hand);
    }
    for (std::string_view key : keys) {
      SCOPED_TRACE(fmt::format("{}: {}", type, key));
      Material material = hand.document().scene.materials[1];
      const MaterialField* known = find_material_field(material_type(material), key);
      if (known == nullptr) {
        for (const char* part : {"", ".r"}) EXPECT_FALSE(hand.find(fmt::format("material.{}{}", key, part)));
        continue;
      }
      const MaterialField& row = *known;
      EXPECT_TRUE(hand.find(widget_of(row, fmt::format("material.{}", row.key))).has_value());
      const Edit value = other_value(row, row.address(material));
      edit(hand, row, fmt::format("material.{}", row.key), value);
      EXPECT_EQ(field_text(row, hand.document().scene.materials[1]), value.text);
      const std::uint64_t after = restarts(hand);
      EXPECT_EQ(after - before, 1u);
      before = after;
    }
  }
}

TEST(ViewerSettingsUi, EveryLightFieldOfEveryType) {
  ViewerHarness hand;
  hand.unfold_all();
  hand.click("lights/0");
  for (int type = 0; type < kLightTypeCount; ++type) {
    const std::string name(light_type_names()[static_cast<std::size_t>(type)]);
    if (light_type(hand.document().scene.lights[0]) != type) hand.choose("light.type", name);
    EXPECT_EQ(light_type(hand.document().scene.lights[0]), type);
    std::uint64_t before = restarts(hand);
    for (const auto& row : light_fields(type)) {
      SCOPED_TRACE(fmt::format("{}: {}", name, row.key));
      LightDesc light = hand.document().scene.lights[0];
      const Edit value = other_value(row, row.address(light));
      edit(hand, row, fmt::format("light.{}", row.key), value);
      EXPECT_EQ(field_text(row, hand.document().scene.lights[0]), value.text);
      const std::uint64_t after = restarts(hand);
      EXPECT_EQ(after - before, 1u);
      before = after;
    }
  }
  hand.click("emitters/3");
  hand.frame(3); // fewer rows: what is scrolled moves
  hand.type_into("emitter.emission.r", "2.5");
  EXPECT_EQ(hand.document().scene.materials[3].emission, vec3(2.5f, 12, 5));
}

TEST(ViewerSettingsUi, TheColourPickerEdits) {
  ViewerHarness hand;
  hand.unfold_all();
  hand.click("materials/1");
  const vec3 before = color(hand.document().scene.materials[1], "diffuse");
  hand.click("material.diffuse.swatch");
  hand.frame(2);
  const auto picker = hand.find("material.diffuse.picker");
  ASSERT_TRUE(picker);
  hand.click(picker->lo + 0.3f * (picker->hi - picker->lo));
  EXPECT_NE(color(hand.document().scene.materials[1], "diffuse"), before);
  EXPECT_EQ(document_problem(hand.document()), "");
}

} // namespace
} // namespace candela::test
