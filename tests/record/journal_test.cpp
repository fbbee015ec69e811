#include "harness/record/journal.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <csignal>

#include "tests/support/fake.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

using namespace test;

/// A journal's file in a temporary folder, and the lines of two rows.
struct JournalFile : InFolder {
  std::string resume_refusal() const {
    return refusal([&] { Journal(file, Journal::Mode::resume); });
  }
  const fs::path file = folder.path / "j.jsonl";
  const std::string first = to_line(sample_row("a")) + "\n", second = to_line(sample_row("b")) + "\n";
};

TEST(RowLine, ComesBackAsItWent) {
  Row row = sample_row("a");
  row.axes["curl.radius"] = ".05";  // a number, but not one of JSON
  row.axes["curl.turns"] = "1e1";   // JSON prints it as 10.0
  const std::string line = to_line(row);
  EXPECT_EQ(line.find('\n'), std::string::npos);
  const Row back = row_from_line(line);
  EXPECT_EQ(to_line(back), line);
  EXPECT_EQ(back.samples.at("frame").wall_ms, row.samples.at("frame").wall_ms);
  EXPECT_EQ(back.samples.at("frame").cpu_ms, (std::vector<double>{20.5, 21.25, 0}));
  EXPECT_EQ(back.axes, row.axes);
  EXPECT_EQ(back.metrics.at("paper_fps").high, 1.0);
  EXPECT_FALSE(back.metrics.at("paper_fps").low);
  EXPECT_EQ(nlohmann::json::parse(line)["axes"]["layers"], 16);
}

// Rows that earlier versions wrote have no CPU times.
TEST(RowLine, CpuTimesMayBeMissing) {
  const std::string body =  // the row up to its checksum
      R"({"schema":1,"run_id":"r","experiment":"e","case":"c","variant":"v","axes":{},"overrides":{},"device":"d",)"
      R"("repeat":0,"status":"ok","reason":"","check":[{"against":"a","metric":"m","value":2.0,"limit":1.0,)"
      R"("sense":">="}],"samples":{"frame":{"event_ms":[],"wall_ms":[1.5]}},)"
      R"("metrics":{},"build_ms":0.0,"first_launch_ms":0.0,"tuning":{},"image_hash":"","provenance":{})";
  const auto sum = crc32(0, reinterpret_cast<const Bytef*>(body.data()), uInt(body.size()));
  const Row row = row_from_line(body + fmt::format(",\"crc\":\"{:08x}\"}}", sum));
  EXPECT_EQ(row.samples.at("frame").wall_ms, std::vector<double>{1.5});
  EXPECT_TRUE(row.samples.at("frame").cpu_ms.empty());
  expect_lacks(to_line(row), "cpu_ms");
}

TEST(RowLine, AnyChangedByteIsNoticed) {
  const std::string line = to_line(sample_row("a"));
  for (std::size_t i = 0; i < line.size(); ++i) {
    std::string changed = line;
    changed[i] = char(changed[i] ^ 1);
    EXPECT_NE(refusal([&] { row_from_line(changed); }), "accepted") << i;
  }
  EXPECT_NE(refusal([&] { row_from_line(line + "\"}"); }), "accepted");
}

TEST(RowLine, OnlyOkRowsHaveATime) {
  Row row = sample_row("a");
  EXPECT_EQ(frame_ms(row).size(), 3u);
  for (const Status status : {Status::failed_check, Status::diverged, Status::error, Status::skipped}) {
    row.status = status;
    EXPECT_TRUE(frame_ms(row).empty());
  }
}

TEST(RowLine, DriverTextNeedNotBeUtf8) {
  Row row = sample_row("a");
  row.reason = "log: \xff\xfe \u00fc end";
  expect_has(row_from_line(to_line(row)).reason, "\u00fc end");
  expect_has(to_line(row), "\u00fc end");
}

TEST_F(JournalFile, KeepsRowsAcrossProcesses) {
  const fs::path deep = folder.path / "deep" / "er" / "j.jsonl";
  {
    Journal journal(deep, Journal::Mode::fresh);
    journal.append(sample_row("a"));
    journal.append(sample_row("b"));
  }
  EXPECT_NE(fs::status(deep).permissions() & fs::perms::owner_read, fs::perms::none);
  Journal journal(deep, Journal::Mode::resume);
  ASSERT_EQ(journal.rows().size(), 2u);
  EXPECT_TRUE(journal.holds(row_key(sample_row("a"))));
  EXPECT_FALSE(journal.holds(row_key(sample_row("c"))));
}

TEST_F(JournalFile, ATornTailAtEveryByteIsDroppedOnResumeOnly) {
  for (std::size_t cut = 0; cut <= second.size(); ++cut) {
    write_text(file, first + second.substr(0, cut));
    const bool whole = cut == second.size();
    if (cut > 0 && !whole) {
      expect_has(refusal([&] { Journal(file, Journal::Mode::fresh); }), "--resume");
      EXPECT_EQ(text_of(file).size(), first.size() + cut) << "a refusal must not change the file";
    }
    Journal journal(file, Journal::Mode::resume);
    ASSERT_EQ(journal.rows().size(), whole ? 2u : 1u) << cut;
    EXPECT_EQ(journal.dropped_bytes(), whole ? 0u : cut);
    if (!whole) journal.append(sample_row("b"));
    EXPECT_EQ(text_of(file), first + second) << cut;
  }
}

TEST_F(JournalFile, DamageInTheMiddleIsAnError) {
  for (std::size_t i = 0; i < first.size(); i += 7) {
    std::string damaged = first + second;
    damaged[i] = char(damaged[i] ^ 4);
    write_text(file, damaged);
    const std::string said = resume_refusal();
    EXPECT_NE(said.find("j.jsonl:1: damaged"), std::string::npos) << i << ": " << said;
    EXPECT_EQ(text_of(file), damaged);
  }
  write_text(file, first + "\n" + second);
  expect_has(resume_refusal(), ":2: damaged");
}

TEST_F(JournalFile, LinesMayEndAsInWindows) {
  std::string text = first + second;
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.insert(at, "\r");
  write_text(file, text);
  Journal journal(file, Journal::Mode::resume);
  EXPECT_EQ(journal.rows().size(), 2u);
  EXPECT_EQ(journal.dropped_bytes(), 0u);
}

TEST_F(JournalFile, AKeyStandsOnce) {
  {
    Journal journal(file, Journal::Mode::fresh);
    journal.append(sample_row("a"));
    expect_has(refusal([&] { journal.append(sample_row("a")); }), "already contains the row");
    Row repeat = sample_row("a"), changed = sample_row("a");
    repeat.repeat = 1;
    changed.overrides["fur.length"] = "0.1";
    journal.append(repeat);
    journal.append(changed);
  }
  write_text(file, first + first);
  expect_has(resume_refusal(), "second row");
}

TEST_F(JournalFile, OneWriterAtATime) {
  Journal journal(file, Journal::Mode::fresh);
  expect_has(resume_refusal(), "another pelage");
}

TEST_F(JournalFile, ReadersPassOverATornTail) {
  write_text(file, first + first.substr(0, 20));
  EXPECT_EQ(read_contents(file).rows.size(), 1u);
  EXPECT_NE(refusal([&] { read_contents(folder.path / "absent.jsonl"); }), "accepted");
}

// A row that a newer version of pelage wrote is not damaged. The error message must not advise the user to
// delete it.
TEST_F(JournalFile, ARowOfANewerVersionIsNotCalledDamaged) {
  Row row = sample_row("a");
  row.schema = 4;
  write_text(file, to_line(row) + "\n");
  const std::string text = refusal([&] { read_contents(file); });
  expect_has(text, "j.jsonl:1: the row has schema 4");
  expect_lacks(text, "delete");
}

TEST_F(JournalFile, AFailedCaseRunsAgain) {
  Row failed = sample_row("a");
  failed.status = Status::error;
  failed.reason = "disk full";
  failed.samples.clear();
  {
    Journal journal(file, Journal::Mode::fresh);
    journal.append(failed);
    EXPECT_FALSE(journal.holds(row_key(failed)));
    journal.append(failed);
    journal.append(sample_row("a"));
    EXPECT_TRUE(journal.holds(row_key(failed)));
    EXPECT_NE(refusal([&] { journal.append(failed); }), "accepted");
  }
  const std::vector<Row> rows = read_contents(file).rows;
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows.front().status, Status::ok);
}

// The functions below replace system calls of the journal. `g_faults` selects which calls fail. It is
// global, because the journal takes plain function pointers.
struct Faults {
  int interrupts = 0;
  std::size_t most = std::string::npos;  // number of bytes that one call writes
  int fail_write_after = -1;
  bool write_nothing = false, fail_sync = false;
} g_faults;

ssize_t bad_write(int descriptor, const void* data, std::size_t size) {
  if (g_faults.interrupts > 0) {
    --g_faults.interrupts;
    errno = EINTR;
    return -1;
  }
  if (g_faults.fail_write_after == 0) {
    g_faults.fail_write_after = -1;  // a second try would succeed
    errno = g_faults.write_nothing ? EINTR : ENOSPC;
    return g_faults.write_nothing ? 0 : -1;
  }
  if (g_faults.fail_write_after > 0) --g_faults.fail_write_after;
  return ::write(descriptor, data, std::min(size, g_faults.most));
}

int bad_sync(int descriptor) {
  if (g_faults.fail_sync) {
    errno = EIO;
    return -1;
  }
  return ::fdatasync(descriptor);
}

struct BadCalls : JournalFile {
  void SetUp() override { g_faults = {}; }
  JournalCalls calls{bad_write, bad_sync, ::ftruncate};
};

TEST_F(BadCalls, InterruptedAndShortWritesAreFinished) {
  Journal journal(file, Journal::Mode::fresh, calls);
  g_faults.most = 1;
  journal.append(sample_row("a"));
  g_faults.interrupts = 3;
  journal.append(sample_row("b"));
  EXPECT_EQ(text_of(file), first + second);
}

TEST_F(BadCalls, AFullDiskLeavesWhatWasAcknowledged) {
  const std::size_t writes = second.size() / 40;
  for (int after = 0; after <= int(writes); ++after) {
    fs::remove(file);
    g_faults = {};
    Journal journal(file, Journal::Mode::fresh, calls);
    journal.append(sample_row("a"));
    g_faults.most = 40;
    g_faults.fail_write_after = after;
    g_faults.write_nothing = after % 2 == 1;
    expect_has(refusal([&] { journal.append(sample_row("b")); }), "No space left");
    EXPECT_EQ(text_of(file), first);
    g_faults = {};
    EXPECT_NE(refusal([&] { journal.append(sample_row("c")); }), "accepted")
        << "a broken journal takes no more";
  }
}

TEST_F(BadCalls, AFailedSyncIsNotRetried) {
  Journal journal(file, Journal::Mode::fresh, calls);
  g_faults.fail_sync = true;
  expect_has(refusal([&] { journal.append(sample_row("a")); }), "synced");
  const fs::path torn = folder.path / "torn.jsonl";
  write_text(torn, "{");
  expect_has(refusal([&] { Journal(torn, Journal::Mode::resume, calls); }), "cannot remove the truncated");
  g_faults.fail_sync = false;
  EXPECT_NE(refusal([&] { journal.append(sample_row("b")); }), "accepted");
}

// The test limits the size of files with setrlimit(). The operating system then writes only a part of the
// second row and reports an error. The journal must remove this part.
TEST_F(JournalFile, ARealLimitOnTheFile) {
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{first.size() + 100, first.size() + 100};
    setrlimit(RLIMIT_FSIZE, &limit);
    close(STDIN_FILENO);  // sync() and then the journal get the descriptor 0
    sync(folder.path);
    Journal journal(file, Journal::Mode::fresh);
    journal.append(sample_row("a"));
    _exit(refusal([&] { journal.append(sample_row("b")); }) == "accepted" ? 1 : 0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(text_of(file), first);
}

TEST_F(JournalFile, APlaceThatCannotBeWritten) {
  folder.write("file", "x");
  EXPECT_NE(refusal([&] { Journal(folder.path / "file" / "j.jsonl", Journal::Mode::fresh); }), "accepted");
  EXPECT_NE(refusal([&] { Journal("/proc/pelage/j.jsonl", Journal::Mode::fresh); }), "accepted");
  expect_has(refusal([&] { sync(folder.path / "absent"); }), "absent: cannot be synced");
  sync("/dev/null");  // has no fsync(), like the folders of some file systems
}

}  // namespace
}  // namespace pelage
