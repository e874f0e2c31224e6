#include "sculpt/pipeline/stages.hpp"

#include <sys/resource.h>

#include <algorithm>

namespace sculpt {
namespace {

double seconds_between(std::chrono::steady_clock::time_point a, std::chrono::steady_clock::time_point b) {
  return std::chrono::duration<double>(b - a).count();
}

}  // namespace

std::int64_t peak_kib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

Stages::Stages() : begin_(Clock::now()), last_(begin_) {}

void Stages::end(const std::string& name) {
  const auto now = Clock::now();
  stages_.push_back({name, seconds_between(last_, now), peak_kib()});
  last_ = now;
}

double Stages::seconds() const { return seconds_between(begin_, Clock::now()); }

void Stages::print(const Comm& comm, const Log& log, std::int64_t hexes) const {
  log.line();
  log.line("  {:<28} {:>10} {:>7} {:>14} {:>14}", "Stage", "time (s)", "share", "peak MB/rank",
           "peak MB, all");
  double total = 0;
  for (const Stage& s : stages_) total += comm.max(s.seconds);
  std::int64_t peak = 0;
  for (const Stage& s : stages_) {
    const double slowest = comm.max(s.seconds);
    peak = comm.sum(s.peak_kib);
    log.line("  {:<28} {:>10.3f} {:>6.1f}% {:>14.1f} {:>14.1f}", s.name, slowest,
             total > 0 ? 100 * slowest / total : 0.0, static_cast<double>(comm.max(s.peak_kib)) / 1024,
             static_cast<double>(peak) / 1024);
  }
  if (hexes > 0)
    log.line("  {:<28} {:>10.3f}         {:.0f} hexes/s/rank, {:.0f} bytes/hex", "Total", total,
             static_cast<double>(hexes) / total / comm.size(),
             1024 * static_cast<double>(peak) / static_cast<double>(hexes));
}

}  // namespace sculpt
