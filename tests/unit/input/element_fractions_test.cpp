#include "sculpt/input/element_fractions.hpp"
#include "input_fixture.hpp"

namespace sculpt {
namespace {

using Names = std::vector<std::string>;

// One element, number 17 of the file.
ElementFractions one(const Names& names, const std::vector<double>& value) {
  return element_fractions(Comm::self(), "mesh.g", names, std::vector<GlobalId>{16}, value);
}
std::string complaint(const Names& names, const std::vector<double>& value) {
  return error_of([&] { (void)one(names, value); });
}
std::vector<std::int64_t> ids(const Names& names) {
  std::vector<double> value(names.size(), 0.0);
  value[0] = 1;
  return one(names, value).table.block_id;
}

TEST(ElementFractions, MaterialsAreNumberedByTheirNames) {
  EXPECT_EQ(ids({"vf_2", "vf_7", "vf_4"}), (std::vector<std::int64_t>{2, 4, 7}));
  EXPECT_EQ(ids({"7", "x07y12"}), (std::vector<std::int64_t>{7, 12}));
  EXPECT_EQ(ids({"vf_2", "vf_02"}), (std::vector<std::int64_t>{1, 2}));
  EXPECT_EQ(ids({"vf_0", "vf_5"}), (std::vector<std::int64_t>{1, 2}));
  EXPECT_EQ(ids({"iron", "vf_5", ""}), (std::vector<std::int64_t>{1, 2, 3}));
  EXPECT_EQ(ids({"vf_99999999999", "vf_5"}), (std::vector<std::int64_t>{1, 2}));
  const ElementFractions f = one({"vf_9", "vf_3"}, {0.75, 0.25});
  EXPECT_EQ(f.fractions.material, (std::vector<std::int32_t>{0, 1}));
  EXPECT_EQ(f.fractions.value, (std::vector<double>{0.25, 0.75}));
  EXPECT_FALSE(f.table.void_material);
}

TEST(ElementFractions, AreNormalised) {
  const std::vector<GlobalId> element{5, 3, 9};
  const std::vector<double> value{1, 0, 0, 0.3, 0.7000005, -1e-7, 1e-13, 0, 1.0000005};
  const ElementFractions f = element_fractions(Comm::self(), "m", Names{"a", "b", "c"}, element, value);
  EXPECT_EQ(f.fractions.offset, (std::vector<std::int64_t>{0, 1, 3, 4}));
  EXPECT_EQ(f.fractions.material, (std::vector<std::int32_t>{0, 0, 1, 2}));
  EXPECT_EQ(f.fractions.value[0], 1);
  EXPECT_EQ(f.fractions.value[1], 0.3 / 1.0000005);
  EXPECT_EQ(f.fractions.value[3], 1);
  expect_valid({f.table, f.fractions});
  EXPECT_EQ(element_fractions(Comm::self(), "m", Names{"a"}, {}, {}).fractions.cells(), 0);
}

TEST(ElementFractions, ThoseOfDoublePrecisionStayAsTheyAre) {
  const double third = 1.0 / 3;
  const std::vector<double> value{third, third, third, 1e-14, 0, 1 - 1e-15};
  const ElementFractions f =
      element_fractions(Comm::self(), "m", Names{"a", "b", "c"}, std::vector<GlobalId>{0, 1}, value);
  EXPECT_EQ(f.fractions.material, (std::vector<std::int32_t>{0, 1, 2, 0, 2}));
  EXPECT_EQ(f.fractions.value, (std::vector<double>{third, third, third, 1e-14, 1 - 1e-15}));
}

TEST(ElementFractions, SinglePrecisionIsGoodEnough) {
  const Names names(60, "vf");
  std::vector<double> value(60, static_cast<double>(1.0F / 60));
  value[3] += 5e-6;  // 60 roundings of 1e-7
  EXPECT_EQ(complaint(names, value), "");
  value[3] += 5e-6;
  EXPECT_TRUE(contains(complaint(names, value), "sum to 1.0000"));
}

TEST(ElementFractions, WrongOnesAreRefused) {
  EXPECT_EQ(complaint({"vf_1", "vf_2"}, {0.9, 0.03}),
            "'mesh.g', element 17: the fractions of its materials sum to 0.93, expected 1");
  EXPECT_EQ(complaint({"vf_1", "vf_2"}, {1.2, -0.2}),
            "'mesh.g', element 17: fraction 1.2 of variable 'vf_1', expected 0 to 1");
  EXPECT_EQ(complaint({"vf_1", "vf_2"}, {1, -0.2}),
            "'mesh.g', element 17: fraction -0.2 of variable 'vf_2', expected 0 to 1");
  EXPECT_EQ(complaint({"vf_1", "vf_2"}, {std::nan(""), 1}),
            "'mesh.g', element 17: fraction nan of variable 'vf_1', expected 0 to 1");
  EXPECT_EQ(complaint({}, {}), "'mesh.g' has no element variables, expected the fractions of the materials");
  EXPECT_EQ(error_of([] {
              (void)element_fractions(Comm::self(), "m", Names{"a"}, std::vector<GlobalId>{7, 2, 4, 3},
                                      std::vector<double>{0, 1, 0.5, 0.25});
            }),
            "'m', element 4: the fractions of its materials sum to 0.25, expected 1");
}

}  // namespace
}  // namespace sculpt
