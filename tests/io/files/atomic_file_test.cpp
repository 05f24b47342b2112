#include "core/error.h"
#include "io/files/atomic_file.h"
#include "support/exit_code.h"
#include "support/scratch_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <functional>
#include <mutex>
#include <set>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

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
  std::jthread writer([&](const std::stop_token& stop) {
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

/// The exit code of check_writable(); done if it does not throw.
ExitCode checked(const std::string& path) {
  return test::code_of([&] { check_writable(path); });
}

TEST(CheckWritable, SaysBeforehandWhatWritingWouldSay) {
  ScratchFolder folder;
  write_file_atomically(folder / "file", "old");
  fs::create_directory(folder / "sub");
  fs::create_symlink("sub", folder / "to_folder");
  fs::create_symlink("nowhere/x.png", folder / "to_missing_folder");
  fs::create_symlink("loop", folder / "loop");
  for (const std::string& path :
       {folder / "no/x.png", folder / "sub", folder / "sub/", folder / "sub/.", folder / "to_folder",
        folder / "to_missing_folder", folder / "loop", folder / "file/x.png", folder / "new/",
        folder / std::string(256, 'n'), std::string(), std::string("/proc/x.png")}) {
    EXPECT_EQ(checked(path), ExitCode::output) << path;
    EXPECT_EQ(test::code_of([&] { write_file_atomically(path, "x"); }), ExitCode::output) << path;
  }
  fs::create_symlink("fresh", folder / "to_fresh");
  const std::size_t before = entries(folder.path());
  for (const std::string& path : {folder / "file", folder / "new", folder / "to_fresh", folder / "sub/x",
                                  folder / std::string(255, 'n'), std::string("/dev/null")})
    EXPECT_EQ(checked(path), ExitCode::done) << path;
  EXPECT_EQ(entries(folder.path()), before) << "it leaves nothing";
  EXPECT_EQ(test::read_text(folder / "file"), "old");
}

/// Runs in a child process of another user, since permissions do not restrict root. Returns its exit status.
int as_nobody(const std::function<int()>& work) {
  const pid_t child = ::fork();
  if (child == 0) {
    const bool changed = ::geteuid() != 0 || (::setgid(65534) == 0 && ::setuid(65534) == 0);
    ::_exit(changed ? work() : 77);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(CheckWritable, PermissionsAreLookedAt) {
  ScratchFolder folder;
  fs::permissions(folder.path(), fs::perms(0777));
  fs::create_directory(folder / "closed");
  fs::permissions(folder / "closed", fs::perms(0555));
  write_file_atomically(folder / "readonly", "x");
  fs::permissions(folder / "readonly", fs::perms(0444));
  write_file_atomically(folder / "closed_file", "x");
  fs::create_directory(folder / "shared"); // like /tmp: everybody may write, but not take others' names away
  write_file_atomically(folder / "shared/others", "x");
  fs::permissions(folder / "shared/others", fs::perms(0666));
  fs::permissions(folder / "shared", fs::perms(01777));
  const int refused = as_nobody([&] {
    int count = 0;
    for (const char* path : {"closed/x", "readonly", "shared/others"})
      count += checked(folder / path) == ExitCode::output &&
               test::code_of([&] { write_file_atomically(folder / path, "y"); }) == ExitCode::output;
    return count + (checked(folder / "shared/mine") == ExitCode::done ? 10 : 0);
  });
  if (::geteuid() == 0) { EXPECT_EQ(refused, 13); } // else the files are our own
  EXPECT_EQ(test::read_text(folder / "shared/others"), "x");
}

TEST(AtomicFile, DescriptorsAreWrittenToWhereTheyStand) {
  ScratchFolder folder;
  const std::string path = folder / "log";
  write_file_atomically(path, "before\n");
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  ASSERT_GE(descriptor, 0);
  fs::create_symlink(fmt::format("/proc/self/fd/{}", descriptor), folder / "link");
  for (const std::string& name : {fmt::format("/dev/fd/{}", descriptor),
                                  fmt::format("/proc/self/fd/{}", descriptor), folder / "link"}) {
    EXPECT_EQ(checked(name), ExitCode::done);
    EXPECT_TRUE(is_stream(name));
    write_file_atomically(name, "line\n");
  }
  ::close(descriptor);
  EXPECT_EQ(test::read_text(path), "before\nline\nline\nline\n") << "neither replaced nor overwritten";
  EXPECT_EQ(checked(fmt::format("/dev/fd/{}", descriptor)), ExitCode::output) << "it is closed";
  const int reading = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  EXPECT_EQ(checked(fmt::format("/dev/fd/{}", reading)), ExitCode::output);
  ::close(reading);
}

} // namespace
} // namespace candela
