#include "io/output_file.h"

#include <thread>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "io/errors.h"
#include "tests/support/file_size_limit.h"
#include "tests/support/temporary_folder.h"

namespace supple {
namespace {

namespace fs = std::filesystem;

void write_whole(const fs::path& path, std::string_view bytes) {
  OutputFile file(path);
  file.write(bytes);
  file.commit();
}

/// The superuser may write everywhere, so it becomes another as long as this lives.
class PlainUser {
 public:
  PlainUser() {
    const uid_t plain = user_ == 0 ? nobody : user_;
    EXPECT_EQ(::seteuid(plain), 0);
  }
  ~PlainUser() { EXPECT_EQ(::seteuid(user_), 0); }

 private:
  static constexpr uid_t nobody = 65534;
  uid_t user_ = ::geteuid();
};

TEST(OutputFile, AppearsOnlyOnCommit) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.txt";
  OutputFile file(path);
  file.write("one ");
  file.write("two");
  EXPECT_FALSE(fs::exists(path));
  file.commit();
  EXPECT_EQ(bytes_of(path), "one two");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(OutputFile, WithoutCommitTheOldFileStays) {
  const TemporaryFolder folder;
  const fs::path path = folder.put("a.txt", "old");
  { OutputFile(path).write("new"); }
  EXPECT_EQ(bytes_of(path), "old");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(OutputFile, WritesMoreThanItsBuffer) {
  const TemporaryFolder folder;
  const std::string bytes(3'000'001, 'x');
  write_whole(folder / "large", bytes);
  EXPECT_EQ(bytes_of(folder / "large"), bytes);
}

TEST(OutputFile, TwoAtOnceOnOnePathDoNotMix) {
  const TemporaryFolder folder;
  OutputFile first(folder / "a"), second(folder / "a");
  first.write("first");
  second.write("second");
  first.commit();
  EXPECT_EQ(bytes_of(folder / "a"), "first");
  second.commit();
  EXPECT_EQ(bytes_of(folder / "a"), "second");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(OutputFile, FullDeviceIsAnError) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "skipped: no /dev/full";
  const std::string message = message_of<OutputError>([] { write_whole("/dev/full", "x"); });
  EXPECT_NE(message.find("/dev/full"), std::string::npos) << message;
  EXPECT_NE(message.find("No space left on device (ENOSPC)"), std::string::npos) << message;
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST(OutputFile, DeviceIsWrittenToAndNotReplaced) {
  write_whole("/dev/null", "x");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  check_writable("/dev/null");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(OutputFile, FailureAtAnyByteKeepsTheOldFile) {
  const TemporaryFolder folder;
  const fs::path path = folder.put("a", "old");
  const std::string bytes(1'000'000, 'x');
  for (const rlim_t limit : {0, 1, 4096, 262'144, 999'999}) {
    const FileSizeLimit held(limit);
    const std::string message = message_of<OutputError>([&] { write_whole(path, bytes); });
    EXPECT_NE(message.find("(EFBIG)"), std::string::npos) << message;
    EXPECT_EQ(bytes_of(path), "old") << limit;
    EXPECT_EQ(folder.entries(), 1) << limit;
  }
}

TEST(OutputFile, PipeCarriesTheBytes) {
  const TemporaryFolder folder;
  const fs::path path = folder / "pipe";
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  std::string received;
  std::thread reader([&] { received = bytes_of(path); });
  write_whole(path, "through");
  reader.join();
  EXPECT_EQ(received, "through");
  EXPECT_TRUE(fs::is_fifo(path));
}

TEST(OutputFile, LinkStaysALinkAndPermissionsStay) {
  const TemporaryFolder folder;
  const fs::path target = folder.put("target", "old");
  fs::permissions(target, fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("target", folder / "link");
  write_whole(folder / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(bytes_of(target), "new");
  EXPECT_EQ(fs::status(target).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST(OutputFile, OddNamesWork) {
  const TemporaryFolder folder;
  for (const std::string& name :
       {std::string("sp ace"), std::string("new\nline"), std::string("\xff\xfe{}%s"),
        std::string("-o"), std::string(255, 'n')}) {
    write_whole(folder / name, name);
    EXPECT_EQ(bytes_of(folder / name), name);
  }
  EXPECT_EQ(folder.entries(), 5);
}

TEST(CheckWritable, LeavesNothingBehind) {
  const TemporaryFolder folder;
  check_writable(folder / "new");
  EXPECT_EQ(folder.entries(), 0);
  const fs::path path = folder.put("old", "old");
  check_writable(path);
  EXPECT_EQ(bytes_of(path), "old");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(CheckWritable, RelativePathIsInTheCurrentFolder) {
  const TemporaryFolder folder;
  const fs::path before = fs::current_path();
  fs::current_path(folder.path());
  write_whole("plain", "x");
  fs::current_path(before);
  EXPECT_EQ(bytes_of(folder / "plain"), "x");
}

TEST(CheckWritable, SaysWhatIsWrong) {
  const TemporaryFolder folder;
  folder.put("file", "x");
  const std::pair<fs::path, std::string> cases[] = {
      {folder / "missing/a.obj", "No such file or directory"},
      {folder / "file/a.obj", "Not a directory"},
      {folder.path(), "it is a folder"},
      {folder / "new/", "it names a folder"},
      {"", "no name"},
      {"/proc/a.obj", ""},
  };
  for (const auto& wrong : cases) {
    const std::string message = message_of<OutputError>([&] { check_writable(wrong.first); });
    EXPECT_NE(message.find(wrong.second), std::string::npos) << message;
    EXPECT_NE(message.find(wrong.first.string()), std::string::npos) << message;
  }
}

TEST(CheckWritable, ReadOnlyFolderOrFile) {
  const TemporaryFolder folder;
  fs::permissions(folder.path(), fs::perms::all);
  fs::create_directory(folder / "closed");
  fs::permissions(folder / "closed", fs::perms::owner_read | fs::perms::owner_exec);
  fs::permissions(folder.put("kept", "x"), fs::perms::owner_read);
  const PlainUser user;
  EXPECT_THROW(check_writable(folder / "closed/a"), OutputError);
  EXPECT_THROW(check_writable(folder / "kept"), OutputError);
  EXPECT_THROW(write_whole(folder / "kept", "y"), OutputError);
  EXPECT_EQ(folder.entries(), 2);
}

}  // namespace
}  // namespace supple
