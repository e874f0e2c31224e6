#include <benchmark/benchmark.h>

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "grains.hpp"
#include "input/number_stream.hpp"

namespace sculpt {
namespace {

// A file of voxels that goes away with its owner.
class SpnFile {
 public:
  explicit SpnFile(std::int64_t n) {
    const int descriptor = mkstemp(path_.data());
    if (descriptor < 0) throw std::runtime_error("cannot create " + path_);
    close(descriptor);
    microstructure::GrainOptions options;
    options.n = {n, n, n};
    options.grains = n;
    write_spn(path_, make_grains(options));
  }
  ~SpnFile() { unlink(path_.c_str()); }
  SpnFile(const SpnFile&) = delete;
  SpnFile& operator=(const SpnFile&) = delete;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_ = P_tmpdir "/sculpt-kernels-XXXXXX";
};

void scan_spn(benchmark::State& state) {
  const SpnFile spn(state.range(0));
  const TextFile file(spn.path(), "input_spn");
  const Comm alone = Comm::self();
  std::int64_t numbers = 0;
  for (auto round : state) {
    NumberStream<IntegerText> stream(alone, file, 0, file.size());
    while (stream.next(alone)) benchmark::DoNotOptimize(stream.values().data());
    numbers += stream.total();
  }
  state.SetItemsProcessed(numbers);
  state.SetBytesProcessed(state.iterations() * file.size());
}
BENCHMARK(scan_spn)->Arg(50)->Arg(100)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace sculpt
