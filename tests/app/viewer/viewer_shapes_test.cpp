// The Objects panel names every shape, and shows and edits the values that its kind has.

#include "app/harness.h"

#include <fmt/format.h>

#include <set>

namespace candela::test {
namespace {

/// It alone, under a light.
Document document_of(const Shape& shape) {
  Document document = test_document();
  document.scene.instances = {{"", shape, mat4(1), {0}}};
  return document;
}

std::vector<Shape> all_shapes() {
  Mesh triangle;
  triangle.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  triangle.triangles = {{0, 1, 2}};
  std::vector<Shape> shapes = {std::make_shared<const Mesh>(triangle)};
  for (std::string_view name : shape_names())
    if (auto shape = shape_of_name(name)) shapes.push_back(*shape);
  return shapes;
}

/// The names of the widgets that begin with "object.".
std::set<std::string> object_widgets(const ViewerHarness& hand) {
  std::set<std::string> names;
  for (const WidgetRecord& widget : hand.viewer.widgets())
    if (widget.name.starts_with("object.")) names.insert(widget.name);
  return names;
}

void select(ViewerHarness& hand) {
  hand.unfold("panel.objects", "list.objects");
  hand.click("objects/0");
  hand.frame(2);
}

TEST(ViewerShapesUi, EveryShapeIsNamedAndShowsTheValuesOfItsKindAndNoOthers) {
  const std::vector<Shape> shapes = all_shapes();
  ASSERT_EQ(shapes.size(), shape_names().size());
  std::set<std::string> keys; // of all kinds
  for (const Shape& shape : shapes)
    for (const auto& row : shape_fields(shape)) keys.insert(fmt::format("object.{}", row.key));
  EXPECT_TRUE(keys.contains("object.minor_radius"));
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    SCOPED_TRACE(shape_name(shapes[i]));
    ViewerHarness hand(document_of(shapes[i]));
    select(hand);
    std::set<std::string> expected{fmt::format("object.shape/{}", shape_name(shapes[i]))};
    for (const auto& row : shape_fields(shapes[i])) expected.insert(fmt::format("object.{}", row.key));
    std::set<std::string> shown;
    for (const std::string& name : object_widgets(hand))
      if (name.starts_with("object.shape/") || keys.contains(name)) shown.insert(name);
    EXPECT_EQ(shown, expected);
    if (shape_name(shapes[i]) == "torus") hand.screenshot("object_torus");
  }
}

TEST(ViewerShapesUi, EveryValueIsEditedUndoneAndKeptWithinItsLimits) {
  for (const Shape& given : all_shapes()) {
    if (shape_fields(given).empty()) continue;
    ViewerHarness hand(document_of(given));
    hand.wait_for_picture();
    select(hand);
    for (const auto& row : shape_fields(given)) {
      SCOPED_TRACE(fmt::format("{}: {}", shape_name(given), row.key));
      const std::string name = fmt::format("object.{}", row.key);
      auto shape = [&]() -> const Shape& { return hand.document().scene.instances[0].shape; };
      auto text = [&] { return field_text(row, shape()); };
      const std::string before = text();
      const std::uint64_t restarts = hand.viewer.session().status().restarts;
      if (row.type == FieldType::boolean) {
        hand.click(name);
        hand.frame(2);
        EXPECT_NE(text(), before);
      } else if (row.type == FieldType::choice) {
        hand.choose(name, std::string(row.choices.back()));
        EXPECT_EQ(text(), row.choices.back());
        EXPECT_NE(text(), before);
      } else {
        for (const char* typed : {"0", "-3", "1e30", "0.2"}) {
          hand.type_into(name, typed);
          EXPECT_EQ(document_problem(hand.document()), "") << typed;
          EXPECT_NE(text(), before) << typed;
        }
        if (row.key != "radius" || shape_name(given) != "torus") { EXPECT_EQ(text(), "0.2"); }
      }
      hand.wait_until("it is rendered", [&] { return hand.viewer.session().status().restarts > restarts; });
      hand.wait_for_picture();
      EXPECT_EQ(hand.state().undo_name, fmt::format("Object 0: {}", row.key));
      for (int k = 0; k < 10 && text() != before; ++k) hand.click("undo"), hand.frame(2);
      EXPECT_EQ(text(), before);
      EXPECT_EQ(shape(), given);
    }
  }
}

TEST(ViewerShapesUi, ATorusKeepsItsTubeThinnerThanItsCircle) {
  ViewerHarness hand(document_of(TorusShape{1, 0.25f}));
  select(hand);
  auto torus = [&] { return std::get<TorusShape>(hand.document().scene.instances[0].shape); };
  hand.type_into("object.minor_radius", "7");
  EXPECT_LT(torus().minor_radius, torus().radius);
  EXPECT_GT(torus().minor_radius, 0.99f);
  hand.type_into("object.minor_radius", "0.5");
  hand.type_into("object.radius", "0.1");
  EXPECT_EQ(torus().minor_radius, 0.5f);
  EXPECT_GT(torus().radius, 0.5f);
  EXPECT_LT(torus().radius, 0.501f);
  hand.double_click("object.radius");
  hand.frame(2);
  EXPECT_EQ(torus().radius, 1) << "as it was loaded";
}

} // namespace
} // namespace candela::test
