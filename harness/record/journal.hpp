// The append-only journal of rows: one file with one line per case. If the program is killed, no complete row
// is lost.
//
// The journal follows rules for durable writing that SQLite and RocksDB also follow. A lock admits only one
// writer, and the file is opened with O_APPEND. Each write is one whole line with a checksum, continued after
// an interruption or a partial write. A row counts as written only after fdatasync. The folder of the journal
// is synced when the file is opened. If a write fails, for instance on a full disk, the file is truncated to
// its last complete row and append() throws. If fdatasync fails, append() throws and does not retry.
// Mode::resume removes a truncated last line, which has no line feed. Any other damage is an error.
//
// These rules do not protect rows that a disk loses in a power failure.
#pragma once
#include <sys/types.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "harness/record/row.hpp"

namespace pelage {

/// Flushes the content of a file, or the list of names in a folder, to the disk. A new file in a folder is
/// durable only after a sync of the folder. Throws InputError.
void sync(const std::filesystem::path& path);

/// The system calls that a journal uses, which tests replace by functions that fail.
struct JournalCalls {
  ssize_t (*write)(int, const void*, std::size_t);
  int (*fdatasync)(int);
  int (*ftruncate)(int, off_t);
};
JournalCalls system_calls();

class Journal {
 public:
  enum class Mode { fresh, resume };

  /// Opens or creates `file` (and its folder), locks it and reads the existing rows. Throws InputError if the
  /// file cannot be written, another process is writing it, a line is damaged, two rows have the same key and
  /// the earlier row does not have the status error, or the last line is truncated and `mode` is fresh.
  Journal(const std::filesystem::path& file, Mode mode, JournalCalls calls = system_calls());
  ~Journal();
  Journal(Journal&&) = delete;

  /// Rows that the file contained when it was opened, without rows with the status error that later rows
  /// replace.
  const std::vector<Row>& rows() const { return rows_; }
  /// Whether the file contains a row with this key and a status other than error.
  bool holds(const std::string& key) const { return keys_.contains(key); }
  /// Length of the truncated last line that was removed, in bytes.
  std::size_t dropped_bytes() const { return dropped_; }
  const std::filesystem::path& file() const { return file_; }

  /// Appends a row and syncs the file to the disk. Throws InputError if holds() is true for the row's key, if
  /// the disk is full, or if an I/O error occurs. An incomplete row is removed from the file; if fdatasync
  /// fails, the row remains, but may be lost in a crash of the system.
  void append(const Row& row);

 private:
  void write_all(const std::string& text);

  std::filesystem::path file_;
  JournalCalls calls_;
  int descriptor_;
  off_t good_length_;
  std::size_t dropped_;
  bool broken_ = false;
  std::vector<Row> rows_;
  std::set<std::string> keys_;  // keys of the rows whose status is not error
};

/// The rows of a journal, and the parts of the file that contribute no row.
struct JournalContents {
  std::vector<Row> rows;      ///< without rows with the status error that later rows of this journal replace
  std::vector<Row> replaced;  ///< those rows
  std::size_t torn = 0;       ///< length of the last line in bytes if the line is incomplete, otherwise 0
};

/// Reads a journal, even while another process writes it: takes no lock, and leaves out a last line that is
/// not yet complete. Throws InputError for a damaged line.
JournalContents read_contents(const std::filesystem::path& file);

}  // namespace pelage
