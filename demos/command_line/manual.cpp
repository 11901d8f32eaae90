#include "command_line/manual.h"

#include <algorithm>
#include <regex>
#include <sstream>
#include <string_view>
#include <vector>

#include "command_line/help.h"

namespace octoblisk::demos {
namespace {

/// Where the manual is written to, in one of two languages.
class Page {
 public:
  virtual ~Page() = default;
  virtual void heading(int level, const std::string& text) = 0;
  /// Paragraphs, separated by an empty line, and items. Each item begins with "- ".
  virtual void prose(const std::string& text) = 0;
  virtual void usage(const std::string& call) = 0;
  virtual void option(const std::string& head, const std::string& text) = 0;

  std::string text() const { return out_.str(); }

 protected:
  std::ostringstream out_;
};

/// Paragraphs and items, each on one line.
std::vector<std::string> blocksOf(const std::string& text) {
  std::vector<std::string> blocks;
  std::istringstream lines(text);
  bool is_new = true;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("- ")) is_new = true;
    if (!line.empty()) {
      if (is_new) {
        blocks.push_back(line);
      } else {
        blocks.back() += ' ' + line.substr(line.find_first_not_of(' '));
      }
    }
    is_new = line.empty();
  }
  return blocks;
}

std::string replaced(std::string text, std::string_view part, std::string_view by) {
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += by.size()) {
    text.replace(at, part.size(), by);
  }
  return text;
}

class MarkdownPage final : public Page {
 public:
  void heading(int level, const std::string& text) override {
    out_ << '\n' << std::string(static_cast<std::size_t>(level), '#') << ' ' << text << '\n';
  }

  void prose(const std::string& text) override {
    bool is_list = false;
    for (const std::string& block : blocksOf(text)) {
      const bool is_item = block.starts_with("- ");
      if (!is_item || !is_list) out_ << '\n';
      write(block, is_item ? "  " : "");
      is_list = is_item;
    }
    is_list_ = false;
  }

  void usage(const std::string& call) override {
    out_ << "\nUsage: `" << call << "`\n";
    is_list_ = false;
  }

  void option(const std::string& head, const std::string& text) override {
    if (!is_list_) out_ << '\n';
    is_list_ = true;
    out_ << "- `" << head << "`\n";
    write("  " + marked(text), "  ");
  }

 private:
  static std::string marked(const std::string& text) { return replaced(text, "<", "&lt;"); }

  /// Options, and commands in quotes, as code.
  static std::string withCode(const std::string& text) {
    static const std::regex code(R"('(octoblisk[^']*)'|(--[a-z][a-z0-9-]*))");
    return std::regex_replace(text, code, "`$1$2`");
  }

  void write(const std::string& block, const std::string& indentation) {
    constexpr std::size_t kWidth = 116;
    const std::string first = block.substr(0, block.starts_with("  ") ? 2 : 0);
    bool is_first = true;
    for (const std::string& line : wrapped(withCode(block), kWidth)) {
      out_ << (is_first ? first : indentation) << line << '\n';
      is_first = false;
    }
  }

  bool is_list_ = false;
};

class ManPage final : public Page {
 public:
  explicit ManPage(const std::string& version) {
    out_ << ".\\\" SPDX-License-Identifier: Zlib\n.TH OCTOBLISK 1 \"\" \"octoblisk " << version
         << "\" \"User Commands\"\n";
  }

  void heading(int level, const std::string& text) override {
    out_ << (level == 1 ? ".SH " : ".SS ") << escaped(text) << '\n';
  }

  void prose(const std::string& text) override {
    for (const std::string& block : blocksOf(text)) {
      const bool is_item = block.starts_with("- ");
      out_ << (is_item ? ".IP \\(bu 2\n" : ".PP\n") << escaped(is_item ? block.substr(2) : block) << '\n';
    }
  }

  void usage(const std::string& call) override { out_ << ".PP\n.B " << escaped(call) << '\n'; }

  void option(const std::string& head, const std::string& text) override {
    out_ << ".TP\n.B " << escaped(head) << '\n' << escaped(text) << '\n';
  }

 private:
  static std::string escaped(const std::string& text) {
    const std::string plain = replaced(replaced(text, "\\", "\\e"), "-", "\\-");
    return plain.starts_with('.') || plain.starts_with('\'') ? "\\&" + plain : plain;
  }
};

bool isOfHelp(const CLI::App& command, const CLI::Option* option) {
  return option == command.get_help_ptr() || option == command.get_help_all_ptr();
}

/// An option. The root's help options stand for those of the subcommands.
struct Entry {
  std::string group, head, text;
  bool operator==(const Entry&) const = default;
};

std::vector<Entry> entriesOf(const CLI::App& command) {
  std::vector<Entry> entries;
  for (const std::string& group : command.get_groups()) {
    for (const CLI::Option* option : command.get_options()) {
      if (group.empty() || option->get_group() != group) continue;
      if (command.get_parent() != nullptr && isOfHelp(command, option)) continue;
      entries.push_back({group, headOf(*option), textOf(*option)});
    }
  }
  return entries;
}

void writeOptions(Page& page, const std::vector<Entry>& entries) {
  std::string group = "Options";
  for (const Entry& entry : entries) {
    if (entry.group != group) page.prose(entry.group + ':');
    group = entry.group;
    page.option(entry.head, entry.text);
  }
}

std::string fullNameOf(const CLI::App& command) {
  return (command.get_parent() == nullptr ? "" : fullNameOf(*command.get_parent()) + ' ') +
         command.get_name();
}

std::string usageOf(const CLI::App& command) {
  constexpr std::size_t kLabel = 7;  // "Usage: "
  const std::string usage = HelpFormatter().make_usage(&command, fullNameOf(command));
  return usage.substr(kLabel, usage.size() - kLabel - 1);
}

void writeCommand(Page& page, const CLI::App& command, int level);

/// One after another; those with the same options together.
void writeSubcommands(Page& page, const CLI::App& command, int level) {
  const std::vector<const CLI::App*> all = command.get_subcommands([](const CLI::App*) { return true; });
  for (auto first = all.begin(); first != all.end();) {
    const std::vector<Entry> entries = entriesOf(**first);
    const auto end = std::find_if(first, all.end(), [&](const CLI::App* other) {
      return other != *first && (!other->get_subcommands({}).empty() || entriesOf(*other) != entries);
    });
    if (end - first == 1) {
      writeCommand(page, **first, level);
    } else {
      std::string title = fullNameOf(command), items;
      for (auto at = first; at != end; ++at) {
        title += (at == first ? " " : at + 1 == end ? " and " : ", ") + (*at)->get_name();
        items += "- " + (*at)->get_name() + ": " + (*at)->get_description() + '\n';
      }
      page.heading(level, title);
      page.prose(items + "\nOptions of each:");
      writeOptions(page, entries);
    }
    first = end;
  }
}

void writeCommand(Page& page, const CLI::App& command, int level) {
  page.heading(level, fullNameOf(command));
  page.prose(command.get_description());
  page.usage(usageOf(command));
  writeOptions(page, entriesOf(command));
  const std::string footer = command.get_footer();
  if (footer != command.get_parent()->get_footer()) page.prose(footer);
  writeSubcommands(page, command, level + 1);
}

/// Below the title, or NAME and SYNOPSIS.
void writeAll(Page& page, const CLI::App& app, int level) {
  page.prose(app.get_description());
  page.usage(usageOf(app));
  writeOptions(page, entriesOf(app));
  page.prose(app.get_footer());
  writeSubcommands(page, app, level);
}

}  // namespace

std::string manualInMarkdown(const CLI::App& app) {
  MarkdownPage page;
  writeAll(page, app, 2);
  return "# The octoblisk command\n\n<!-- `./dev manual` writes this page from the program's --help. -->\n" +
         page.text();
}

std::string manualForMan(const CLI::App& app, const std::string& version) {
  ManPage page(version);
  page.heading(1, "NAME");
  page.prose("octoblisk - check an abrasive belt against a bladed disk");
  page.heading(1, "DESCRIPTION");
  writeAll(page, app, 2);
  return page.text();
}

}  // namespace octoblisk::demos
