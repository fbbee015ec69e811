// The source files of a program, and the build options that they read.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace pelage::cl {

/// Maps the path of a kernel file, relative to the kernel folder, to the hash of the file's contents.
using Sources = std::map<std::string, std::uint64_t>;
/// Maps the path of a kernel file, relative to the kernel folder, to the file's contents.
using SourceTexts = std::map<std::string, std::string>;

/// Returns the contents of `file` and of every file that it includes, directly or indirectly. Throws
/// InputError if a file is missing.
SourceTexts source_texts(const std::filesystem::path& file);
Sources hashes_of(const SourceTexts& texts);
/// Returns the hashes of source_texts(file).
Sources sources_of(const std::filesystem::path& file);

/// Returns 16 hex digits: the FNV-1a hash of the paths and contents of the files.
std::string hash_of(const Sources& sources);

/// Returns the options without each "-D NAME" and "-D NAME=VALUE" whose NAME no source reads. Such an option
/// changes nothing in the program, but drivers would compile the program again for each value.
std::string options_read(const std::string& options, const SourceTexts& sources);

}  // namespace pelage::cl
