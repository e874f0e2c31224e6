// kernels [--benchmark_filter=...]: the inner loops of the mesher, one rank.
#include <benchmark/benchmark.h>

#include "sculpt/par/comm.hpp"

int main(int argc, char** argv) {
  const sculpt::MpiSession session(argc, argv);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
