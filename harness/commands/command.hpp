// The interface of a command of pelage. Each command has one file with a function add_NAME(app, chosen),
// which main() calls. add_NAME declares the command's options on `app`. If the command line names the
// command, CLI11 calls the command's callback. The callback stores a function in `chosen`, and main() then
// runs the stored function. The stored function returns the exit code (0 done, 1 a check failed, 4
// missing shards or cases, 5 a regression) or throws: main() turns InputError into exit code 2, NoDeviceError
// into 3, and every other exception into 1. Commands write data to stdout and messages to stderr.
// harness/commands/devices.cpp is a short example.
#pragma once
#include <CLI/CLI.hpp>
#include <functional>

namespace pelage {

using Chosen = std::function<int()>;

}  // namespace pelage
