#pragma once
// The numbers of a large text file, read by all ranks together. The text is dealt out in rounds: in each
// round every rank reads one piece of at most kPieceBytes, the pieces following each other in rank order, so
// that each byte is read once and the memory in use does not grow with the file. A number belongs to the
// piece in which it starts.
#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "input/number_text.hpp"
#include "input/text_file.hpp"
#include "sculpt/par/comm.hpp"

namespace sculpt {

template <class Text>
class NumberStream {
 public:
  using Value = typename Text::Value;

  // The numbers that start in the bytes [begin, end), which are the same on all ranks. The file must outlive
  // the stream.
  NumberStream(const Comm& comm, const TextFile& file, std::int64_t begin, std::int64_t end)
      : file_(file), next_(begin), size_(end), ranks_(comm.size()) {
    const std::int64_t share = (end - begin + ranks_ - 1) / ranks_;
    piece_ = std::clamp<std::int64_t>(share, 1, kPieceBytes);
  }

  // Collective. Reads the next round; false when there is none. Throws AgreedError for text that is no
  // number.
  bool next(const Comm& comm) {
    if (next_ >= size_) return false;
    begin_ = std::min(size_, next_ + piece_ * comm.rank());
    end_ = std::min(size_, begin_ + piece_);
    next_ += piece_ * ranks_;
    collectively(comm, "reading " + file_.path(), [this] { read_piece(); });
    counts_ = comm.gather_all(count_);
    firsts_.resize(counts_.size());
    for (std::size_t r = 0; r < counts_.size(); ++r) {
      firsts_[r] = total_;
      total_ += counts_[r];
    }
    return true;
  }

  // Of this round: my numbers, and of each rank the index of its first number in the file and how many it
  // has.
  [[nodiscard]] std::span<const Value> values() const {
    return std::span<const Value>(values_).first(static_cast<std::size_t>(count_));
  }
  [[nodiscard]] std::span<const std::int64_t> firsts() const { return firsts_; }
  [[nodiscard]] std::span<const std::int64_t> counts() const { return counts_; }
  // Numbers up to the end of this round.
  [[nodiscard]] std::int64_t total() const { return total_; }

  // Local. Up to `count` numbers that follow my last one; fewer at the end of the file or before text that is
  // no number (which the rank that owns it reports).
  [[nodiscard]] std::vector<Value> following(std::int64_t count) const {
    std::vector<Value> values(static_cast<std::size_t>(count));
    std::int64_t have = 0, at = end_;
    while (have < count && at < size_) {
      const std::int64_t stop = std::min(size_, at + kFollowBytes);
      const Buffer text = load(at, stop);
      const Scan scan = scan_numbers(text, stop, values.data() + have, count - have);
      have += scan.count;
      if (scan.bad) break;
      at = stop;
    }
    values.resize(static_cast<std::size_t>(have));
    return values;
  }

  // Local. Byte at which my number with this index (from 0 in values()) starts: for messages.
  [[nodiscard]] std::int64_t offset_of(std::int64_t index) const {
    const Buffer text = load(begin_, end_);
    std::vector<Value> values(static_cast<std::size_t>(index + 1));
    return scan_numbers(text, end_, values.data(), index + 1).last;
  }

 private:
  static constexpr std::int64_t kPieceBytes = std::int64_t{8} << 20;
  static constexpr std::int64_t kLongestNumber =
      256;  // bytes read beyond a piece to see its last number whole
  static constexpr std::int64_t kFollowBytes = std::int64_t{16} << 10;

  struct Buffer {
    std::vector<char> bytes;  // the text from `offset` on, and one character that ends it
    std::int64_t offset = 0;
    std::int64_t begin = 0;  // the piece starts here: bytes before it only tell whether a number is under way
  };
  struct Scan {
    std::int64_t count = 0;
    std::int64_t last = 0;            // where the last number starts
    std::optional<std::int64_t> bad;  // where text starts that is no number
  };

  void load(std::int64_t begin, std::int64_t end, Buffer& text) const {
    text.begin = begin;
    text.offset = std::max<std::int64_t>(0, begin - 1);
    const std::int64_t stop = std::min(file_.size(), end + kLongestNumber);
    text.bytes.resize(static_cast<std::size_t>(stop - text.offset + 1));
    file_.read(text.offset, std::span(text.bytes).first(text.bytes.size() - 1));
    text.bytes.back() = stop == file_.size() ? ' ' : '\0';
  }
  [[nodiscard]] Buffer load(std::int64_t begin, std::int64_t end) const {
    Buffer text;
    load(begin, end, text);
    return text;
  }

  // Scans at most `most` numbers that start before `end`.
  [[nodiscard]] static Scan scan_numbers(const Buffer& text, std::int64_t end, Value* values,
                                         std::int64_t most) {
    const char* const base = text.bytes.data();
    const char* const limit = base + text.bytes.size() - 1;
    const char* const stop = base + (end - text.offset);
    const char* p = base + (text.begin - text.offset);
    if (p != base && !Text::separates(p[-1]))
      while (p < stop && !Text::separates(*p)) ++p;
    Scan scan;
    const char* last = p;
    while (scan.count < most) {
      while (p < stop && Text::separates(*p)) ++p;
      if (p >= stop) break;
      const char* const after = Text::parse(p, limit, values[scan.count]);
      last = p;
      if (after == nullptr || !Text::separates(*after)) {
        scan.bad = text.offset + (p - base);
        break;
      }
      ++scan.count;
      p = after;
    }
    scan.last = text.offset + (last - base);
    return scan;
  }

  void read_piece() {
    count_ = 0;
    if (begin_ == end_) return;
    load(begin_, end_, text_);
    // A number takes at least one character and a separator.
    const std::size_t most = static_cast<std::size_t>((end_ - begin_ + 1) / 2);
    if (values_.size() < most) values_.resize(most);
    const Scan scan = scan_numbers(text_, end_, values_.data(), static_cast<std::int64_t>(values_.size()));
    count_ = scan.count;
    if (scan.bad) report(*scan.bad);
  }

  [[noreturn]] void report(std::int64_t offset) const {
    const char* const start = text_.bytes.data() + (offset - text_.offset);
    const char* const end = text_.bytes.data() + text_.bytes.size() - 1;
    const std::string found(start, std::find_if(start, end, Text::separates));
    throw Error(
        fmt::format("{}found {}, expected {}", file_.place(offset), sculpt::quoted(found), Text::expected()));
  }

  const TextFile& file_;
  std::int64_t next_, size_;
  int ranks_;
  std::int64_t piece_ = 0, begin_ = 0, end_ = 0, count_ = 0, total_ = 0;
  Buffer text_;
  std::vector<Value> values_;
  std::vector<std::int64_t> firsts_, counts_;
};

}  // namespace sculpt
