#include "grinding/tool_file.h"

#include <algorithm>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "io/input_file.h"
#include "io/new_file.h"
#include "io/quoted_text.h"
#include "io/table_name.h"
#include "models/length_limit.h"

namespace octoblisk::demos {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kMaxBladeNumber = 10'000;
const std::string kAny = "any";

/// A value of the file, and its name in messages.
class Item {
 public:
  Item(const std::filesystem::path& file, const Json& json, std::string key)
      : file_(file), json_(json), key_(std::move(key)) {}

  [[noreturn]] void refuse(const std::string& what) const {
    throw std::runtime_error(file_.string() + ": " + (key_.empty() ? "" : key_ + ": ") + what);
  }

  /// The value of a key of this object; none if the key is missing.
  std::optional<Item> find(const std::string& key) const {
    const auto found = json_.find(key);
    if (found == json_.end()) return std::nullopt;
    return Item(file_, *found, key_.empty() ? key : key_ + "." + key);
  }
  Item at(const std::string& key) const {
    if (const auto found = find(key)) return *found;
    refuse("the key \"" + key + "\" is missing: add it");
  }

  void requireObject(std::initializer_list<std::string_view> known) const {
    if (!json_.is_object()) refuse("must be an object {...}");
    for (const auto& [key, value] : json_.items()) {
      if (std::ranges::find(known, key) != known.end()) continue;
      std::string names;
      for (const std::string_view name : known) names += (names.empty() ? "" : ", ") + std::string(name);
      refuse("unknown key " + inQuotes(key) + "; the keys are: " + names);
    }
  }
  std::vector<Item> list() const {
    if (!json_.is_array()) refuse("must be a list [...]");
    std::vector<Item> items;
    for (std::size_t i = 0; i < json_.size(); ++i)
      items.push_back(Item(file_, json_[i], key_ + "[" + std::to_string(i) + "]"));
    return items;
  }
  std::string text() const {
    if (!json_.is_string()) refuse("must be text in double quotes");
    return json_.get<std::string>();
  }
  double number(double least, double greatest) const {
    if (!json_.is_number()) refuse("must be a number");
    const auto value = json_.get<double>();
    if (value >= least && value <= greatest) return value;
    std::ostringstream range;
    range << "must be a number from " << least << " to " << greatest;
    refuse(range.str());
  }
  const Json& json() const { return json_; }

 private:
  const std::filesystem::path& file_;
  const Json& json_;
  std::string key_;
};

std::string nameOfPart(const Item& item) {
  const std::string name = item.text();
  if (!isTableName(name)) item.refuse(kTableNameRule);
  if (name == kAny) item.refuse("this name is reserved for \"every part\": choose another");
  return name;
}

ToolFilePart partOf(const Item& item, const std::filesystem::path& folder) {
  item.requireObject({"name", "mesh", "max_depth_mm", "belt_speed_m_s"});
  ToolFilePart part{nameOfPart(item.at("name")), {}, {}};
  const Item mesh = item.at("mesh");
  const std::string name = mesh.text();
  if (name.empty()) mesh.refuse("the name is empty");
  const auto is_control = [](char letter) { return (letter >= 0 && letter < ' ') || letter == 0x7f; };
  if (std::ranges::any_of(name, is_control)) mesh.refuse("a file name must not contain control characters");
  part.mesh = folder / name;
  std::error_code ignored;
  if (!std::filesystem::exists(part.mesh, ignored))
    mesh.refuse(part.mesh.string() + ": no such file: name it relative to the tool's file");
  if (const auto depth = item.find("max_depth_mm")) part.max_depth = depth->number(0.0, kMaxLength);
  if (const auto speed = item.find("belt_speed_m_s")) {
    part.belt_speed = speed->number(-kMaxBeltSpeed, kMaxBeltSpeed);
  }
  return part;
}

std::optional<std::size_t> partNumber(const Item& item, const std::vector<ToolFilePart>& parts) {
  const std::string name = item.text();
  if (name == kAny) return std::nullopt;
  const auto found = std::ranges::find(parts, name, &ToolFilePart::name);
  if (found == parts.end()) item.refuse("no part is named " + inQuotes(name));
  return static_cast<std::size_t>(found - parts.begin());
}

BladeChoice bladeOf(const Item& item) {
  using Kind = BladeChoice::Kind;
  if (item.json().is_string()) {
    const std::string name = item.text();
    if (name == kAny) return {Kind::any, 0};
    if (name == "hub") return {Kind::hub, 0};
    if (name == "ground") return {Kind::ground, 0};
  } else if (item.json().is_number_integer()) {
    return {Kind::number, static_cast<int>(item.number(1, kMaxBladeNumber))};
  }
  item.refuse("must be a blade number from 1, \"ground\", \"hub\" or \"any\"");
}

/// Throws if a key is repeated: JSON would silently keep only one of its values.
Json parse(const std::filesystem::path& file) {
  std::ifstream stream = openForReading(file);
  const std::string content{std::istreambuf_iterator<char>(stream), {}};
  std::vector<std::set<std::string>> keys;
  const auto watch = [&](int, Json::parse_event_t event, Json& parsed) {
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event == Json::parse_event_t::key && !keys.back().insert(parsed.get<std::string>()).second) {
      throw std::runtime_error(file.string() + ": the key " + inQuotes(parsed.get<std::string>()) +
                               " is repeated in one object");
    }
    return true;
  };
  try {
    return Json::parse(content, watch);
  } catch (const Json::parse_error& error) {
    const auto line =
        1 + std::count(content.begin(),
                       content.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, content.size())),
                       '\n');
    throw std::runtime_error(file.string() + ":" + std::to_string(line) +
                             ": not valid JSON: 'octoblisk make grinder' writes an example");
  } catch (const Json::exception&) {
    throw std::runtime_error(file.string() + ": a number is too large for a 64-bit float");
  }
}

Json choice(const BladeChoice& blade) {
  switch (blade.kind) {
    case BladeChoice::Kind::any:
      return kAny;
    case BladeChoice::Kind::hub:
      return "hub";
    case BladeChoice::Kind::ground:
      return "ground";
    case BladeChoice::Kind::number:
      return blade.number;
  }
  return {};
}

}  // namespace

ToolFile readToolFile(const std::filesystem::path& file) {
  const Json json = parse(file);
  const Item root(file, json, "");
  root.requireObject({"parts", "allowed", "margins"});
  ToolFile tool;
  const Item parts = root.at("parts");
  for (const Item& item : parts.list()) {
    ToolFilePart part = partOf(item, file.parent_path());
    if (std::ranges::find(tool.parts, part.name, &ToolFilePart::name) != tool.parts.end()) {
      item.at("name").refuse("two parts are named " + inQuotes(part.name));
    }
    tool.parts.push_back(std::move(part));
  }
  if (tool.parts.empty()) parts.refuse("must have at least one part");
  if (const auto allowed = root.find("allowed")) {
    for (const Item& row : allowed->list()) {
      row.requireObject({"part", "blade"});
      tool.allowed.push_back({partNumber(row.at("part"), tool.parts), bladeOf(row.at("blade"))});
    }
  }
  if (const auto margins = root.find("margins")) {
    for (const Item& row : margins->list()) {
      row.requireObject({"part", "blade", "near_miss_mm"});
      tool.margins.push_back({partNumber(row.at("part"), tool.parts), bladeOf(row.at("blade")),
                              row.at("near_miss_mm").number(0.0, kMaxNearMiss)});
    }
  }
  return tool;
}

void writeToolFile(const std::filesystem::path& file, const ToolFile& tool) {
  const auto nameOf = [&](const std::optional<std::size_t>& part) {
    return part ? tool.parts[*part].name : kAny;
  };
  Json parts = Json::array(), allowed = Json::array(), margins = Json::array();
  for (const ToolFilePart& part : tool.parts) {
    parts.push_back({{"name", part.name}, {"mesh", part.mesh.generic_string()}});
    if (part.max_depth) parts.back()["max_depth_mm"] = *part.max_depth;
    if (part.belt_speed) parts.back()["belt_speed_m_s"] = *part.belt_speed;
  }
  for (const AllowedPair& row : tool.allowed)
    allowed.push_back({{"part", nameOf(row.part)}, {"blade", choice(row.blade)}});
  for (const PairMargin& row : tool.margins) {
    margins.push_back(
        {{"part", nameOf(row.part)}, {"blade", choice(row.blade)}, {"near_miss_mm", row.near_miss}});
  }
  const Json json = {{"parts", parts}, {"allowed", allowed}, {"margins", margins}};
  std::ostringstream stream;
  stream << json.dump(2) << '\n';
  writeFile(file, stream.str());
}

}  // namespace octoblisk::demos
