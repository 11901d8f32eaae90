#include "study/merge_parts.h"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "base/file.h"
#include "io/input_file.h"
#include "io/new_file.h"
#include "study/part_text.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

/// A part file, mapped to memory.
struct PartFile {
  std::string name;
  std::unique_ptr<const MappedFile> mapped;
  PartText part;

  std::string_view text() const {
    return {reinterpret_cast<const char*>(mapped->bytes().data()), mapped->bytes().size()};
  }
};

[[noreturn]] void refuse(const PartFile& file, const std::string& message) {
  throw std::runtime_error(file.name + ": " + message);
}

std::string itemsText(ItemRange items) {
  return "items " + std::to_string(items.begin) + " to " + std::to_string(items.end);
}

PartFile openPart(const std::filesystem::path& path, const CheckPart& check) {
  PartFile file{path.string(), nullptr, {}};
  openForReading(path);  // gives a better error message
  file.mapped = std::make_unique<const MappedFile>(path);
  try {
    file.part = readPart(file.text());
    if (check) check(file.part, file.text());
  } catch (const std::invalid_argument& error) {
    refuse(file, error.what());
  }
  const std::vector<ItemRange> missing = missingItems(file.part);
  if (!missing.empty()) {
    refuse(file, "is unfinished, truncated or damaged: of its " + itemsText(file.part.items) +
                     " some are missing, from " + std::to_string(missing.front().begin) +
                     ": finish it with --resume");
  }
  if (file.part.sound_bytes != file.text().size())
    refuse(file, "has extra bytes after its end: make the part again");
  return file;
}

void requireSameStudy(const std::vector<PartFile>& files) {
  for (const PartFile& file : files) {
    const std::string difference = differenceOf(files.front().part.study, file.part.study);
    if (!difference.empty()) {
      refuse(file, "belongs to another study than " + files.front().name + ": it has other " + difference);
    }
  }
}

/// Throws unless the sorted files hold each item exactly once.
void requireWhole(const std::vector<PartFile>& files) {
  std::size_t end = 0;
  const PartFile* before = nullptr;
  for (const PartFile& file : files) {
    const ItemRange items = file.part.items;
    if (items.empty()) continue;
    const std::string behind = before ? " after those of " + before->name : std::string();
    if (items.begin > end) {
      refuse(file, "begins at item " + std::to_string(items.begin) + ": " + itemsText({end, items.begin}) +
                       behind + " are missing");
    }
    if (items.begin < end) {
      refuse(file, "repeats items of " + before->name + ", from " + std::to_string(items.begin));
    }
    end = items.end;
    before = &file;
  }
  const std::size_t all = files.front().part.study.items;
  if (end < all) {
    const PartFile& last = before ? *before : files.front();
    refuse(last, "ends before item " + std::to_string(end) + ", and no part has " + itemsText({end, all}));
  }
}

}  // namespace

MergedStudy mergeParts(const std::vector<std::filesystem::path>& parts, const std::string& out,
                       const CheckPart& check) {
  requireNotRead(out, parts);
  std::vector<PartFile> files;
  for (const std::filesystem::path& path : parts) files.push_back(openPart(path, check));
  if (files.empty()) throw std::runtime_error(out + ": no parts: name the files of all parts");
  requireSameStudy(files);
  std::ranges::stable_sort(files, {}, [](const PartFile& file) { return file.part.items.begin; });
  requireWhole(files);

  MergedStudy merged{files.front().part.study, {}};
  NewFile table(out);
  table.write(merged.study.columns + '\n');
  for (PartFile& file : files) {
    std::ranges::sort(file.part.groups, {}, [](const GroupInText& group) { return group.items.begin; });
    for (GroupInText& group : file.part.groups) {
      table.write(file.text().substr(group.begin, group.bytes));
      merged.tallies.push_back(std::move(group.tally));
    }
  }
  table.keep();
  return merged;
}

}  // namespace octoblisk::demos
