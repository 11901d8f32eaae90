#include "study/merge_parts.h"

#include <algorithm>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "io/input_file.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

[[noreturn]] void refuse(const PartFile& file, const std::string& message) {
  throw std::runtime_error(file.name.string() + ": " + message);
}

std::string itemsText(ItemRange items) {
  return "items " + std::to_string(items.begin) + " to " + std::to_string(items.end);
}

PartFile openPart(const std::filesystem::path& path, const CheckPart& check) {
  openForReading(path);  // gives a better error message
  PartFile file(path);
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
      refuse(file,
             "belongs to another study than " + files.front().name.string() + ": it has other " + difference);
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
    const std::string behind = before ? " after those of " + before->name.string() : std::string();
    if (items.begin > end) {
      refuse(file, "begins at item " + std::to_string(items.begin) + ": " + itemsText({end, items.begin}) +
                       behind + " are missing");
    }
    if (items.begin < end) {
      refuse(file, "repeats items of " + before->name.string() + ", from " + std::to_string(items.begin));
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

PartFile::PartFile(std::filesystem::path file)
    : name(std::move(file)), mapped(std::make_shared<const MappedFile>(name)) {}

std::string_view PartFile::text() const {
  if (!mapped) return memory;
  return {reinterpret_cast<const char*>(mapped->bytes().data()), mapped->bytes().size()};
}

std::vector<std::string> writeInOrder(std::span<const PartFile> files, const std::string& head,
                                      NewFile& whole) {
  std::vector<std::pair<const GroupInText*, std::string_view>> groups;  // with their rows
  for (const PartFile& file : files) {
    for (const GroupInText& group : file.part.groups) {
      groups.emplace_back(&group, file.text().substr(group.begin, group.bytes));
    }
  }
  std::ranges::stable_sort(groups, {}, [](const auto& group) { return group.first->items.begin; });
  std::vector<std::string> tallies;
  std::size_t end = 0;
  for (const auto& [group, rows] : groups) {
    if (group->items.begin < end) continue;
    end = group->items.end;
    if (!head.empty()) {
      whole.write(textOf({group->items, std::string(rows), group->tally}, head));
    } else {
      whole.write(rows);
    }
    tallies.push_back(group->tally);
  }
  return tallies;
}

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
  merged.tallies = writeInOrder(files, "", table);
  table.keep();
  return merged;
}

}  // namespace octoblisk::demos
