#include "datasets/yaml_tree.h"

#include <gtest/gtest.h>

#include "tests/support/input_error_of.h"

namespace hoplab {
namespace {

using testing::InputErrorOf;

YamlNode Parsed(const char* text) { return ParseYaml(text, "f.yaml"); }

void Set(YamlNode* root, const char* key, const char* value,
         const std::vector<std::string>& whole_key_maps = {}) {
  SetYaml(*root, key, ParseYamlValue(value, std::string("--set ") + key), whole_key_maps);
}

TEST(YamlTree, EveryNodeKnowsItsLine) {
  const YamlNode root = Parsed("a: 1\nb:\n  c: [x,\n    y]\n");
  EXPECT_EQ(root.Find("a")->place, "f.yaml:1");
  EXPECT_EQ(root.Find("b")->place, "f.yaml:2");
  EXPECT_EQ(root.Find("b")->Find("c")->items[1].place, "f.yaml:4");
}

TEST(YamlTree, AnAliasBecomesACopy) {
  const YamlNode root = Parsed("a: &x {k: 1}\nb: *x\n");
  EXPECT_EQ(root.Find("b")->Find("k")->text, "1");
}

TEST(YamlTree, AliasesThatNestBeyondTheDepthAreRefused) {
  std::string text = "a0: &a0 [x]\n";
  for (int i = 1; i < 40; ++i)
    text += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [*a" + std::to_string(i - 1) +
            "]\n";
  EXPECT_EQ(InputErrorOf([&] { ParseYaml(text, "f.yaml"); }),
            "f.yaml:23: is nested more than 24 deep. Check the brackets and the indentation.");
}

TEST(MergeYaml, TheOverlayWinsKeyByKey) {
  const YamlNode merged = MergeYaml(Parsed("a: 1\nb: {c: 2, d: 3}\n"), Parsed("b: {c: 4}\ne: 5\n"));
  EXPECT_EQ(merged.Find("a")->text, "1");
  EXPECT_EQ(merged.Find("b")->Find("c")->text, "4");
  EXPECT_EQ(merged.Find("b")->Find("d")->text, "3");
  EXPECT_EQ(merged.Find("e")->text, "5");
}

TEST(MergeYaml, NullRemovesAKey) {
  EXPECT_EQ(MergeYaml(Parsed("a: 1\nb: 2\n"), Parsed("a: null\n")).Find("a"), nullptr);
}

TEST(SetYaml, ReplacesAValueAndReportsTheOptionAsItsPlace) {
  YamlNode root = Parsed("a: {b: 1}\n");
  Set(&root, "a.b", "2");
  EXPECT_EQ(root.Find("a")->Find("b")->text, "2");
  EXPECT_EQ(root.Find("a")->Find("b")->place, "--set a.b");
}

TEST(SetYaml, MakesTheMapsOnTheWay) {
  YamlNode root = Parsed("a: 1\n");
  Set(&root, "b.c.d", "[1, 2]");
  EXPECT_EQ(root.Find("b")->Find("c")->Find("d")->items.size(), 2u);
}

TEST(SetYaml, ReachesIntoAList) {
  YamlNode root = Parsed("a: [{b: 1}, {b: 2}]\n");
  Set(&root, "a.1.b", "3");
  EXPECT_EQ(root.Find("a")->items[1].Find("b")->text, "3");
}

TEST(SetYaml, RefusesAPlacePastTheEndOfAList) {
  YamlNode root = Parsed("a: [x]\n");
  EXPECT_EQ(
      InputErrorOf([&] { Set(&root, "a.1", "y"); }),
      "--set a.1: a.1; `1` must be the place in a list of 1, counted from 0. Give a key as it "
      "stands in the file, parts joined by dots: mechanism.leg.E_Pa.");
}

TEST(SetYaml, RefusesAPathThroughAValue) {
  YamlNode root = Parsed("a: 1\n");
  EXPECT_EQ(
      InputErrorOf([&] { Set(&root, "a.b", "y"); }),
      "--set a.b: a.b; leads through a value that has no keys below it. Give a key as it stands "
      "in the file, parts joined by dots: mechanism.leg.E_Pa.");
}

TEST(SetYaml, RefusesAnEmptyPart) {
  YamlNode root = Parsed("a: 1\n");
  EXPECT_EQ(
      InputErrorOf([&] { Set(&root, "b..c", "y"); }),
      "--set b..c: b..c; has an empty part. Give a key as it stands in the file, parts joined "
      "by dots: mechanism.leg.E_Pa.");
}

TEST(SetYaml, TakesTheRestAsOneKeyWhereKeysHaveDots) {
  YamlNode root = Parsed("search: {over: {}}\n");
  Set(&root, "search.over.controller.kp_N_s", "[1, 2]", {"search.over"});
  EXPECT_NE(root.Find("search")->Find("over")->Find("controller.kp_N_s"), nullptr);
}

}  // namespace
}  // namespace hoplab
