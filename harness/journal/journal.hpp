// The append-only journal of rows: one file, one line per case. A kill of the program loses no complete row.
//
// Rules (as in SQLite and RocksDB): one writer (lock); O_APPEND; a whole line per write, each with its
// checksum; interrupted and short writes are completed; a row counts only after fdatasync; the folder is
// synced when the file is created; a full disk truncates the file to the last good length and fails; an error
// of fdatasync stops the run and is never retried. On opening, only a truncated last line (no line feed) may
// be dropped, and only when resuming; damage anywhere else is an error. The rules cover kills of the program,
// not data that the disk loses in a power failure.
#pragma once
#include <sys/types.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "harness/journal/row.hpp"

namespace pelage {

/// The system calls of a journal; tests replace them by failing ones.
struct JournalCalls {
  ssize_t (*write)(int, const void*, std::size_t);
  int (*fdatasync)(int);
  int (*ftruncate)(int, off_t);
};
JournalCalls system_calls();

class Journal {
 public:
  enum class Mode { fresh, resume };

  /// Opens or creates `file` (and its folder), takes the lock and reads the existing rows. Throws InputError
  /// if the file cannot be written, another process writes it, a line is damaged, two lines have the same
  /// key, or (fresh) its last line is truncated.
  Journal(const std::filesystem::path& file, Mode mode, JournalCalls calls = system_calls());
  ~Journal();
  Journal(Journal&& other) noexcept;
  Journal& operator=(Journal&&) = delete;

  const std::vector<Row>& rows() const { return rows_; }                    ///< rows found on opening
  bool holds(const std::string& key) const { return keys_.contains(key); }  ///< found or appended
  std::size_t dropped_bytes() const { return dropped_; }  ///< length of a dropped, truncated last line
  const std::filesystem::path& file() const { return file_; }

  /// Appends a row and returns after the row is on the disk. Throws InputError for an existing key, a full
  /// disk or an I/O error; the file then ends with the last row that was acknowledged.
  void append(const Row& row);

 private:
  void write_all(const std::string& text);

  std::filesystem::path file_;
  JournalCalls calls_;
  int descriptor_ = -1;
  off_t good_length_ = 0;
  std::size_t dropped_ = 0;
  bool broken_ = false;
  std::vector<Row> rows_;
  std::set<std::string> keys_;
};

/// Reads the rows of a journal that another process may be writing (no lock; skips a truncated last line).
/// Throws InputError for a damaged line.
std::vector<Row> read_journal(const std::filesystem::path& file);

}  // namespace pelage
