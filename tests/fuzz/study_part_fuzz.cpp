// Splits any bytes at lines that consist of `%`, and reads them as parts of a study for octoblisk merge and
// as the rest of an unfinished run. They are refused with a one-line message, or give a table of their rows.
// Each input is tried unchanged and with corrected checksums.
#include <cstdio>
#include <optional>

#include "access/access_summary.h"
#include "commands/access_files.h"
#include "commands/check_summary.h"
#include "commands/part_check.h"
#include "fuzz/fuzz_input.h"
#include "study/merge_parts.h"
#include "study/part_text.h"
#include "study/study_journal.h"

using namespace octoblisk;
using namespace octoblisk::demos;

namespace {

std::optional<PartText> readOrRefused(std::string_view text) {
  try {
    return readPart(text);
  } catch (const std::invalid_argument& refusal) {
    if (!std::string_view(refusal.what()).starts_with("is not a part of a study: ") &&
        !std::string_view(refusal.what()).starts_with("repeats item ")) {
      fuzz::fail("an unclear refusal", refusal.what());
    }
  }
  return std::nullopt;
}

std::string_view rowsOf(const GroupInText& group, std::string_view text) {
  return text.substr(group.begin, group.bytes);
}

void requireSame(const PartText& part, const PartText& again) {
  const Study &study = part.study, &read = again.study;
  if (!differenceOf(study, read).empty() || study.inputs != read.inputs) fuzz::fail("the study changed");
  if (part.items != again.items || part.groups.size() != again.groups.size()) fuzz::fail("items were lost");
}

/// Checks that the part survives writing and reading.
std::string writtenAgain(const PartText& part, std::string_view text) {
  std::string written = headOf(part.study, part.items);
  const std::string head = written;
  for (const GroupInText& group : part.groups) {
    written += textOf({group.items, std::string(rowsOf(group, text)), group.tally}, head);
  }
  const PartText again = readPart(written);
  requireSame(part, again);
  if (again.sound_bytes != written.size()) fuzz::fail("what was written is not sound");
  for (std::size_t k = 0; k < part.groups.size(); ++k) {
    const GroupInText &group = part.groups[k], &read = again.groups[k];
    const bool is_same = read.items == group.items && read.tally == group.tally &&
                         rowsOf(read, written) == rowsOf(group, text);
    if (!is_same) fuzz::fail("a group changed");
  }
  return written;
}

void requireMissingIsTheRest(const PartText& part) {
  std::size_t items = 0;
  for (const GroupInText& group : part.groups) items += group.items.size();
  for (const ItemRange& missing : missingItems(part)) items += missing.size();
  if (items != part.items.size()) fuzz::fail("items are neither there nor missing");
}

/// The text with correct checksums, which no fuzzer finds by chance.
std::string withChecksums(std::string_view text) {
  constexpr std::string_view kGroup = "# checksum ", kItems = ", items ";
  const std::size_t head_size = std::min(text.find(kGroup), text.size());
  const std::string_view head = text.substr(0, head_size);
  std::string sound(head);
  text.remove_prefix(head_size);
  while (text.starts_with(kGroup)) {
    const std::size_t items_at = text.find(kItems), end = text.find('\n');
    if (items_at == std::string_view::npos || end == std::string_view::npos || items_at > end) break;
    const std::string line(text.substr(items_at, end - items_at));
    std::size_t begin = 0, past = 0, bytes = 0;
    int tally_at = 0;
    if (std::sscanf(line.c_str(), ", items %zu to %zu, %zu bytes, tally %n", &begin, &past, &bytes,
                    &tally_at) != 3 ||
        tally_at == 0) {
      break;
    }
    const std::string_view rows = text.substr(end + 1, bytes);
    sound +=
        textOf({{begin, past}, std::string(rows), line.substr(static_cast<std::size_t>(tally_at))}, head);
    text.remove_prefix(end + 1 + rows.size());
  }
  return sound.append(text);
}

void resume(const fuzz::ScratchFolder& folder, const PartText& part, std::string_view text) {
  const std::filesystem::path out = folder.path() / "resumed.csv";
  const std::filesystem::path partial = folder.write("resumed.csv.partial", text);
  try {
    StudyJournal journal(part.study, part.items, out, StudyJournal::Form::table, true);
    if (journal.missing() != missingItems(part)) fuzz::fail("answers were lost, or come from nowhere");
    if (!journal.missing().empty()) return;
    journal.finish();
  } catch (const std::runtime_error& refusal) {
    fuzz::requireClear(refusal, partial);
  }
}

/// Reads what octoblisk merge uses after the table is written, when a refusal is too late.
void requireReadable(const MergedStudy& merged, const std::filesystem::path& table) {
  if (merged.study.name == kCheckName) {
    summaryOfTallies(merged.tallies);
    optionsOfLine(merged.study.options);
  }
  if (merged.study.name != kAccessName) return;
  AccessSummary summary;
  for (const std::string& tally : merged.tallies) summary.add(accessSummaryOfTally(tally));
  for (const char letter : summaryText(summary, questionOfLine(merged.study.options))) {
    if (letter != '\n' && (letter < ' ' || letter > '~')) fuzz::fail("bytes of a part reach the terminal");
  }
  if (readAccessTable(table).size() != merged.study.items) fuzz::fail("there are not as many rows as points");
}

void merge(const fuzz::ScratchFolder& folder, const std::vector<std::string>& texts) {
  std::vector<std::filesystem::path> files;
  for (const std::string& text : texts) {
    files.push_back(folder.write("part" + std::to_string(files.size()), text));
  }
  const std::filesystem::path out = folder.path() / "merged.csv";
  std::filesystem::remove(out);
  try {
    const MergedStudy merged = mergeParts(files, out, checkPart);
    std::size_t size = merged.study.columns.size() + 1;
    for (const std::string& text : texts) {
      for (const GroupInText& group : readPart(text).groups) size += group.bytes;
    }
    if (std::filesystem::file_size(out) != size) fuzz::fail("rows were lost");
    requireReadable(merged, out);
  } catch (const std::runtime_error& refusal) {
    fuzz::requireClear(refusal, folder.path() / "part");
    if (std::filesystem::exists(out)) fuzz::fail("a file was written of refused parts");
  }
}

void ask(const fuzz::ScratchFolder& folder, const std::vector<std::string>& texts) {
  for (const std::string& text : texts) {
    const std::optional<PartText> part = readOrRefused(text);
    if (!part) continue;
    requireMissingIsTheRest(*part);
    resume(folder, *part, text);
    resume(folder, *part, writtenAgain(*part, text));
  }
  merge(folder, texts);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::ScratchFolder folder;
  constexpr std::size_t kMaxParts = 8;
  std::vector<std::string> texts, sound;
  for (const std::string_view piece : fuzz::pieces(fuzz::textOf(data, size))) {
    if (texts.size() == kMaxParts) break;
    texts.emplace_back(piece);
    sound.push_back(withChecksums(piece));
  }
  ask(folder, texts);
  ask(folder, sound);
  return 0;
}
