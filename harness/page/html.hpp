// Pieces of the page's HTML.
#pragma once
#include <string>
#include <vector>

namespace pelage {

/// An entry of the page's contents.
struct Entry {
  std::string id, title;
  int level = 1;            ///< 1 for a chapter, 2 for a section in it
  std::string detail = {};  ///< distinguishes entries that have the same title
};

/// The text of the page, with its contents.
class Body {
 public:
  void add(const std::string& html) { html_ += html; }
  /// Adds a heading and its entry in the contents. Level 1 gives an element h2, level 2 gives h3.
  void heading(const std::string& title, int level, const std::string& detail = {});
  /// Adds a text of a paragraph with the class "soft"; nothing for an empty text.
  void remark(const std::string& text);
  /// Adds a button that saves a file of the page's data.
  void save_button(const std::string& file, const std::string& label);
  /// Adds an element "details" with a text in it, whose line breaks are kept.
  void folded(const std::string& title, const std::string& text);

  const std::string& html() const { return html_; }
  const std::vector<Entry>& entries() const { return entries_; }

 private:
  std::string html_;
  std::vector<Entry> entries_;
};

/// Returns the contents as nested lists of links. If several entries have the same title, the links show
/// their details.
std::string contents_of(const std::vector<Entry>& entries);

}  // namespace pelage
