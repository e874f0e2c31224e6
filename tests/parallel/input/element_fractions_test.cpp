// All ranks name the same wrong element, the one with the lowest number in the file.
#include "sculpt/input/element_fractions.hpp"
#include "../../unit/input/input_fixture.hpp"

namespace sculpt {
namespace {

TEST(ElementFractionsParallel, NameTheFirstWrongElement) {
  const Comm comm = Comm::world();
  const std::vector<std::string> names{"a", "b"};
  // Elements are dealt out in turns, the highest ones to rank 0.
  std::vector<GlobalId> element;
  std::vector<double> value;
  for (GlobalId e = 59 - comm.rank(); e >= 0; e -= comm.size()) {
    element.push_back(e);
    const double first = e == 23 || e == 41 ? 0.5 : 0.75;
    value.insert(value.end(), {first, 0.25});
  }
  EXPECT_EQ(error_of([&] { (void)element_fractions(comm, "m", names, element, value); }),
            "'m', element 24: the fractions of its materials sum to 0.75, expected 1");
  for (std::size_t e = 0; e < element.size(); ++e) value[2 * e] = 0.75;
  const ElementFractions f = element_fractions(comm, "m", names, element, value);
  EXPECT_EQ(f.fractions.cells(), static_cast<std::int64_t>(element.size()));
  EXPECT_EQ(f.table.block_id, (std::vector<std::int64_t>{1, 2}));
}

}  // namespace
}  // namespace sculpt
