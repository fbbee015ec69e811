// Builds the HTML of a report's page and its table of contents.
#pragma once
#include <string>
#include <vector>

namespace pelage {

/// An entry of the table of contents.
struct Entry {
  std::string id, title;
  int level = 1;            ///< 1 for a chapter, 2 for a section of a chapter
  std::string detail = {};  ///< distinguishes entries that have the same title
};

/// Collects the HTML text of the page and the entries of its table of contents.
class Body {
 public:
  void add(const std::string& html) { html_ += html; }
  /// Adds a heading and its entry in the table of contents. Level 1 becomes an h2 element, level 2 an h3
  /// element.
  void heading(const std::string& title, int level, const std::string& detail = {});
  /// Adds the text as a paragraph in a softer colour. Adds nothing if the text is empty.
  void remark(const std::string& text);
  /// Adds a button that saves the named file from the page's data.
  void save_button(const std::string& file, const std::string& label);
  /// Adds a "details" element, which shows the text after a click on the title. Line breaks of the text are
  /// kept.
  void folded(const std::string& title, const std::string& text);

  const std::string& html() const { return html_; }
  const std::vector<Entry>& entries() const { return entries_; }

 private:
  std::string html_;
  std::vector<Entry> entries_;
};

/// Returns the table of contents as nested HTML lists of links. If several entries have the same title, their
/// links also show Entry::detail.
std::string contents_of(const std::vector<Entry>& entries);

}  // namespace pelage
