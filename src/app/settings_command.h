#pragma once

#include <string>

namespace candela {

/// `candela settings [--json|--markdown]`: prints the settings table, by default as aligned text. Returns 0.
int run_settings(bool json, bool markdown);

/// What it prints. The Markdown form is the table in the README.
std::string settings_text();
std::string settings_json();
std::string settings_markdown();

} // namespace candela
