#pragma once
// A large text file that several ranks read in pieces. Local: no communication.
#include <cstdint>
#include <span>
#include <string>

namespace sculpt {

class TextFile {
 public:
  // Throws Error when the path is missing, a directory, unreadable, empty or compressed. `option` is the deck
  // option that named the file.
  TextFile(std::string path, const std::string& option);
  ~TextFile();
  TextFile(TextFile&& other) noexcept;
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;
  TextFile& operator=(TextFile&&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::int64_t size() const { return size_; }
  // Fills the span with the bytes from offset on; Error when the file has fewer.
  void read(std::int64_t offset, std::span<char> into) const;
  // Number, from 1, of the line that holds the byte. Reads the file up to there: for messages only.
  [[nodiscard]] std::int64_t line_of(std::int64_t offset) const;
  // "path, line 12: ", the beginning of a message about that byte.
  [[nodiscard]] std::string place(std::int64_t offset) const;

 private:
  std::string path_;
  int descriptor_ = -1;
  std::int64_t size_ = 0;
};

}  // namespace sculpt
