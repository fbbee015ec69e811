// The append-only journal of rows: one file, one line per case, safe against kills.
//
// Rules (after SQLite's and RocksDB's lessons): one writer (lock); O_APPEND; a whole line per write, each
// with its checksum; interrupted and short writes are finished; a row counts only after fdatasync; the folder
// is synced when the file is made; a full disk truncates to the last good length and fails; an error of
// fdatasync stops the run and is never retried. On opening, only a torn last line (no line feed) may be
// dropped, and only when resuming; damage anywhere else is an error. A kill is not a power cut: what the disk
// itself loses, no program brings back.
#pragma once
#include <sys/types.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "harness/journal/row.hpp"

namespace pelage {

/// The system calls that a journal lives on; tests put failing ones in their place.
struct JournalCalls {
  ssize_t (*write)(int, const void*, std::size_t);
  int (*fdatasync)(int);
  int (*ftruncate)(int, off_t);
};
JournalCalls system_calls();

class Journal {
 public:
  enum class Mode { fresh, resume };

  /// Opens or makes `file` (and its folder), takes the lock and reads what is there. Throws InputError:
  /// cannot be written, another process writes it, a line is damaged, two lines have one key, or (fresh) its
  /// end is torn.
  Journal(const std::filesystem::path& file, Mode mode, JournalCalls calls = system_calls());
  ~Journal();
  Journal(Journal&& other) noexcept;
  Journal& operator=(Journal&&) = delete;

  const std::vector<Row>& rows() const { return rows_; }                    ///< those found on opening
  bool holds(const std::string& key) const { return keys_.contains(key); }  ///< found or appended
  std::size_t dropped_bytes() const { return dropped_; }  ///< the torn tail of a resumed journal
  const std::filesystem::path& file() const { return file_; }

  /// Returns once the row is on the disk. Throws InputError for a key that is already there, a full disk or
  /// an I/O error; the file then ends with the last row that was acknowledged.
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

/// Rows of a journal that may still be written to (no lock; a torn tail is passed over). Throws InputError on
/// damage.
std::vector<Row> read_journal(const std::filesystem::path& file);

}  // namespace pelage
