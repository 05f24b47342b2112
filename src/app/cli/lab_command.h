#pragma once
// `candela lab NAME …`: the Monte Carlo lessons of src/lab, run to the end, as text or JSON.

#include <memory>

namespace CLI {
class App;
}

namespace candela {

/// The command, whose options come from the lessons' field tables.
class LabCommand {
public:
  /// Adds `lab` to the program's commands; `program` must outlive this.
  explicit LabCommand(CLI::App& program);
  ~LabCommand();

  bool parsed() const; ///< whether the command line asked for it
  /// Prints the lesson's result on stdout, progress on stderr. Returns 0; throws usage errors.
  int run() const;

private:
  struct Options;
  std::unique_ptr<Options> options_;
};

} // namespace candela
