// The interface of a command of pelage. Each command has one file with a function add_NAME(app, chosen),
// which main() calls. add_NAME declares the command's options on `app`. If the command line names the
// command, CLI11 calls the command's callback. The callback stores a function in `chosen`, and main() then
// runs the stored function. The stored function returns the exit code:
// - 0: success;
// - 1: a check failed;
// - 4: pelage merge found that shards (parts of a run) or cases are missing;
// - 5: pelage compare --fail-on-regression found that a case became slower or has no time.
// If the function throws, main() returns exit code 2 for InputError, 3 for NoDeviceError, and 1 for every
// other exception. Commands write data to stdout and messages to stderr. The file
// harness/commands/devices.cpp is a short example.
#pragma once
#include <CLI/CLI.hpp>
#include <functional>

namespace pelage {

using Chosen = std::function<int()>;

}  // namespace pelage
