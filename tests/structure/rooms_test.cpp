// Compares the includes of every room with the dependencies written in src/CMakeLists.txt.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace sculpt {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = SCULPT_SOURCE_DIR;

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

using Rooms = std::map<std::string, std::set<std::string>>;  // room -> all rooms it may see, itself included

void add_seen(const Rooms& direct, const std::string& room, std::set<std::string>& seen) {
  if (!seen.insert(room).second) return;
  for (const std::string& d : direct.at(room)) add_seen(direct, d, seen);
}

Rooms rooms_with_dependencies() {
  const std::string text = text_of(kRoot / "src/CMakeLists.txt");
  const std::regex call(R"(\n\s*sculpt_room\(([^)]*)\))");
  Rooms direct, all;
  for (std::sregex_iterator c(text.begin(), text.end(), call), end; c != end; ++c) {
    std::istringstream words((*c)[1].str());
    std::string room, word, keyword;
    words >> room;
    direct[room];
    while (words >> word) {
      if (word == "DEPENDS" || word == "LIBRARIES")
        keyword = word;
      else if (keyword == "DEPENDS")
        direct[room].insert(word);
    }
  }
  for (const auto& [room, seen] : direct) add_seen(direct, room, all[room]);
  return all;
}

struct Include {
  fs::path file;  // relative to the source tree
  int line;
  std::string room, header;
};

std::vector<fs::path> sources_below(const std::string& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder))
    if (entry.path().extension() == ".hpp" || entry.path().extension() == ".cpp")
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

// Of src/<room> and include/sculpt/<room>.
std::vector<Include> all_includes() {
  const std::regex include(R"(^\s*#\s*include\s*["<]([^">]+)[">])");
  std::vector<Include> found;
  for (const std::string folder : {"src", "include/sculpt"})
    for (const fs::path& path : sources_below(folder)) {
      const std::string room = fs::relative(path, kRoot / folder).begin()->string();
      std::ifstream file(path);
      std::string line;
      std::smatch match;
      for (int number = 1; std::getline(file, line); ++number)
        if (std::regex_search(line, match, include))
          found.push_back({fs::relative(path, kRoot), number, room, match[1]});
    }
  return found;
}

std::string place(const Include& i) { return fmt::format("{}:{}: {}", i.file.string(), i.line, i.header); }

TEST(Rooms, AreAllListed) {
  const Rooms rooms = rooms_with_dependencies();
  EXPECT_GE(rooms.size(), 10U);
  for (const std::string folder : {"src", "include/sculpt"})
    for (const auto& entry : fs::directory_iterator(kRoot / folder))
      if (entry.is_directory()) EXPECT_TRUE(rooms.contains(entry.path().filename().string())) << entry.path();
}

TEST(Rooms, DependOneWay) {
  const Rooms rooms = rooms_with_dependencies();
  for (const auto& [room, seen] : rooms)
    for (const std::string& other : seen)
      if (other != room)
        EXPECT_FALSE(rooms.at(other).contains(room)) << room << " and " << other << " depend on each other";
}

TEST(Rooms, IncludeOnlyWhatTheyDependOn) {
  const Rooms rooms = rooms_with_dependencies();
  const std::regex public_header("sculpt/([a-z_]+)/[a-z0-9_]+\\.hpp"),
      private_header("([a-z_]+)/[a-z0-9_]+\\.hpp");
  std::smatch match;
  int compared = 0;
  for (const Include& i : all_includes()) {
    if (!rooms.contains(i.room)) continue;  // told by AreAllListed
    if (std::regex_match(i.header, match, public_header)) {
      ++compared;
      EXPECT_TRUE(rooms.at(i.room).contains(match[1]))
          << place(i) << ": not a dependency of " << i.room << " in src/CMakeLists.txt";
    } else if (std::regex_match(i.header, match, private_header) && rooms.contains(match[1])) {
      ++compared;
      EXPECT_EQ(match[1], i.room) << place(i) << ": private header of another room";
      EXPECT_EQ(i.file.begin()->string(), "src") << place(i) << ": private header in a public one";
    }
  }
  EXPECT_GT(compared, 100);
}

TEST(Rooms, WrapTheirLibraries) {
  for (const Include& i : all_includes()) {
    if (i.header == "mpi.h") EXPECT_EQ(i.room, "par") << place(i);
    if (i.header == "exodusII.h" || i.header == "netcdf.h") EXPECT_EQ(i.room, "exo") << place(i);
    if (i.header == "zoltan.h") EXPECT_EQ(i.room, "par") << place(i);
    if (i.header == "create_inline_mesh.h" || i.header.starts_with("pamgen_"))
      EXPECT_EQ(i.room, "input") << place(i);
    EXPECT_FALSE(i.header.starts_with("gtest/")) << place(i);
  }
}

// What mpi.h offers reaches other rooms through Comm only; what the launcher's main() may call is to end the
// job.
TEST(Rooms, LeaveMessagesToPar) {
  const std::regex call(R"(\bMPI_[A-Z][a-z]\w*)");
  for (const fs::path& path : sources_below("src")) {
    const std::string room = fs::relative(path, kRoot / "src").begin()->string(), text = text_of(path);
    if (room == "par") continue;
    for (std::sregex_iterator c(text.begin(), text.end(), call), end; c != end; ++c)
      EXPECT_TRUE(room == "pipeline" && c->str() == "MPI_Abort")
          << fs::relative(path, kRoot) << ": " << c->str();
  }
}

// Two types of one name would be taken for each other by the linker.
TEST(Headers, DefineEveryTypeOnce) {
  const std::regex definition(R"((?:^|\n)(?:struct|class|enum class) (\w+)[^;{\n]*\{)");
  std::map<std::string, std::string> defined;
  for (const std::string folder : {"src", "include"})
    for (const fs::path& path : sources_below(folder)) {
      if (path.extension() != ".hpp") continue;
      const std::string text = text_of(path), where = fs::relative(path, kRoot).string();
      for (std::sregex_iterator d(text.begin(), text.end(), definition), end; d != end; ++d) {
        const auto [first, is_new] = defined.emplace((*d)[1].str(), where);
        EXPECT_TRUE(is_new) << (*d)[1] << " in " << where << " and " << first->second;
      }
    }
  EXPECT_GT(defined.size(), 100U);
}

TEST(Files, AreReadable) {
  for (const std::string folder : {"src", "include", "apps", "tests"})
    for (const fs::path& path : sources_below(folder)) {
      const std::string text = text_of(path);
      EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 1000) << path;
      EXPECT_EQ(text.find('\t'), std::string::npos) << path << ": a tab";
      if (!text.empty()) EXPECT_EQ(text.back(), '\n') << path << ": no newline at the end";
    }
}

TEST(Headers, OpenWithPragmaOnceAndWhatTheyDo) {
  for (const fs::path& path : sources_below("include")) {
    const std::string text = text_of(path);
    EXPECT_TRUE(text.starts_with("#pragma once\n//")) << path;
    EXPECT_EQ(text.find("using namespace"), std::string::npos) << path;
  }
}

}  // namespace
}  // namespace sculpt
