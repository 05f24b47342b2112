#include "core/error.h"
#include "io/atomic_file.h"
#include "support/scratch_folder.h"

#include <gtest/gtest.h>

#include <array>
#include <csignal>
#include <filesystem>
#include <mutex>
#include <set>
#include <sys/resource.h>
#include <sys/stat.h>
#include <thread>

namespace candela {
namespace {

namespace fs = std::filesystem;
using test::ScratchFolder;

std::size_t entries(const std::string& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(AtomicFile, WritesAndReplaces) {
  ScratchFolder folder;
  std::string path = folder / "a.txt";
  write_file_atomically(path, "first, and longer");
  EXPECT_EQ(test::read_text(path), "first, and longer");
  write_file_atomically(path, "second");
  EXPECT_EQ(test::read_text(path), "second");
  EXPECT_EQ(entries(folder.path()), 1u);
}

TEST(AtomicFile, AnEmptyFileIsWritten) {
  ScratchFolder folder;
  write_file_atomically(folder / "empty", "");
  EXPECT_TRUE(fs::exists(folder / "empty"));
  EXPECT_EQ(fs::file_size(folder / "empty"), 0u);
}

TEST(AtomicFile, AMissingFolderIsAnOutputError) {
  ScratchFolder folder;
  try {
    write_file_atomically(folder / "no/such/a.txt", "x");
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::output);
    EXPECT_NE(std::string(error.what()).find("no/such/a.txt"), std::string::npos) << error.what();
  }
  EXPECT_EQ(entries(folder.path()), 0u);
}

TEST(AtomicFile, AFolderIsNotReplaced) {
  ScratchFolder folder;
  fs::create_directory(folder / "sub");
  EXPECT_THROW(write_file_atomically(folder / "sub", "x"), Error);
  EXPECT_TRUE(fs::is_directory(folder / "sub"));
  EXPECT_EQ(entries(folder.path()), 1u);
}

TEST(AtomicFile, ASymbolicLinkStaysOne) {
  ScratchFolder folder;
  write_file_atomically(folder / "real", "old");
  fs::create_symlink("real", folder / "link");
  write_file_atomically(folder / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(test::read_text(folder / "real"), "new");
}

TEST(AtomicFile, PermissionsOfAReplacedFileAreKept) {
  ScratchFolder folder;
  std::string path = folder / "private";
  write_file_atomically(path, "old");
  fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write);
  write_file_atomically(path, "new");
  EXPECT_EQ(fs::status(path).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST(AtomicFile, ALongNameIsWritten) {
  ScratchFolder folder;
  std::string path = folder / std::string(255, 'n');
  write_file_atomically(path, "x");
  EXPECT_EQ(test::read_text(path), "x");
}

TEST(AtomicFile, SpecialFilesAreWrittenToAndStayWhatTheyAre) {
  write_file_atomically("/dev/null", "x");
  EXPECT_FALSE(fs::is_regular_file("/dev/null"));
}

TEST(AtomicFile, ADiskThatFillsUpLeavesTheOldFile) {
  ScratchFolder folder;
  std::string path = folder / "a.txt";
  write_file_atomically(path, "old");
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit small{1000, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  ExitCode code = ExitCode::done;
  try {
    write_file_atomically(path, std::string(5000, 'x'));
  } catch (const Error& error) { code = error.code(); }
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(code, ExitCode::output);
  EXPECT_EQ(test::read_text(path), "old");
  EXPECT_EQ(entries(folder.path()), 1u);
}

TEST(AtomicFile, AnAbandonedFileDisappears) {
  ScratchFolder folder;
  write_file_atomically(folder / "a", "old");
  {
    PendingFile pending(folder / "a");
    pending.write(std::array<std::uint8_t, 3>{1, 2, 3});
    EXPECT_EQ(entries(folder.path()), 2u);
    EXPECT_EQ(fs::path(pending.temporary_path()).parent_path(), fs::path(folder.path()));
  }
  EXPECT_EQ(entries(folder.path()), 1u);
  EXPECT_EQ(test::read_text(folder / "a"), "old");
}

TEST(AtomicFile, ReadersSeeOneOfTheVersionsWhole) {
  ScratchFolder folder;
  std::string path = folder / "a";
  std::string versions[] = {std::string(100000, 'a'), std::string(50000, 'b')};
  write_file_atomically(path, versions[0]);
  std::jthread writer([&](std::stop_token stop) {
    for (int i = 1; !stop.stop_requested(); ++i) write_file_atomically(path, versions[i % 2]);
  });
  for (int i = 0; i < 200; ++i) {
    std::string seen = test::read_text(path);
    ASSERT_TRUE(seen == versions[0] || seen == versions[1]) << seen.size();
  }
}

TEST(AtomicFile, UniqueNamesNeverOverwrite) {
  ScratchFolder folder;
  write_file_atomically(folder / "shot.png", "mine");
  std::array<std::uint8_t, 1> byte{'x'};
  EXPECT_EQ(write_file_uniquely(folder.path(), "shot", ".png", byte), folder / "shot-2.png");
  EXPECT_EQ(write_file_uniquely(folder.path(), "shot", ".png", byte), folder / "shot-3.png");
  EXPECT_EQ(write_file_uniquely(folder.path(), "other", ".png", byte), folder / "other.png");
  EXPECT_EQ(test::read_text(folder / "shot.png"), "mine");
  EXPECT_EQ(test::read_text(folder / "shot-2.png"), "x");
  EXPECT_EQ(entries(folder.path()), 4u);
}

TEST(AtomicFile, UniqueNamesAreNotSharedByARace) {
  ScratchFolder folder;
  constexpr int kThreads = 4, kEach = 25;
  std::mutex mutex;
  std::vector<std::string> paths;
  {
    std::vector<std::jthread> threads;
    for (int t = 0; t < kThreads; ++t)
      threads.emplace_back([&, t] {
        for (int i = 0; i < kEach; ++i) {
          std::array<std::uint8_t, 2> bytes{static_cast<std::uint8_t>(t), static_cast<std::uint8_t>(i)};
          std::string path = write_file_uniquely(folder.path(), "s", ".bin", bytes);
          std::lock_guard lock(mutex);
          paths.push_back(path);
        }
      });
  }

  EXPECT_EQ(std::set(paths.begin(), paths.end()).size(), paths.size());
  ASSERT_EQ(entries(folder.path()), static_cast<std::size_t>(kThreads * kEach));
  std::vector<std::string> contents;
  for (const auto& path : paths) contents.push_back(test::read_text(path));

  EXPECT_EQ(std::set(contents.begin(), contents.end()).size(), contents.size())
      << "one file overwrote another";
}

} // namespace
} // namespace candela
