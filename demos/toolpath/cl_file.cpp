#include "toolpath/cl_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <initializer_list>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "io/quoted_text.h"
#include "octoblisk/triangle_mesh.h"
#include "toolpath/apt_text.h"

namespace octoblisk::demos {
namespace {

constexpr double kMmPerInch = 25.4;
constexpr double kAxisTolerance = 1e-3;  ///< allows for rounding to a few digits; more is a mistake

bool isAmong(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

bool isArc(std::string_view word) {
  return isAmong(word, {"CIRCLE", "ARC", "MOVARC", "ARCMOV", "ARCDAT", "CYLNDR", "HELIX", "INDIRV", "INDIRP",
                        "TLON", "TLLFT", "TLRGT"});
}

bool isOtherMotion(std::string_view word) {
  return isAmong(
      word, {"GO", "GOFWD", "GOBACK", "GOLFT", "GORGT", "GOUP", "GODOWN", "PSIS", "DNTCUT", "SPLINE", "NURBS",
             "POLYLN", "CALL", "MACRO", "TERMAC", "LOOPST", "LOOPND", "JUMPTO", "INCLUD"});
}

bool movesWhatFollows(std::string_view word) {
  return isAmong(word, {"TRACUT", "TRANS", "ROTATE", "ROTABL", "ROTHED", "ORIGIN", "REFSYS", "CSYS", "COPY",
                        "INDEX", "ZSURF", "MIRROR", "OFFSET"});
}

bool loadsTool(std::string_view word) { return isAmong(word, {"LOADTL", "LOAD"}); }

bool isOfNoMeaningHere(std::string_view word) {
  return isAmong(
      word, {"PARTNO",  "PPRINT", "REMARK", "INSERT", "LETTER",      "TPRINT", "DISPLY", "MACHIN", "CUTTER",
             "TOOLNO",  "SELECT", "SELCTL", "TLDATA", "COOLNT",      "OPSTOP", "STOP",   "END",    "DELAY",
             "DWELL",   "AUXFUN", "PREFUN", "SEQNO",  "INTOL",       "OUTTOL", "TOLER",  "LINTOL", "TOOLPATH",
             "PAINT",   "CUT",    "PPFUN",  "CLAMP",  "END-OF-PATH", "CLRSRF", "PITCH",  "MAXIPM", "MAXANG",
             "VTLAXIS", "ISN",    "BREAK",  "LEADER", "PLABEL",      "REWIND", "PROBE"});
}

/// The state of a CL program from one statement to the next.
class ClReader {
 public:
  explicit ClReader(const std::filesystem::path& file) : text_(file) {}

  ClFile read() {
    AptStatement statement;
    bool is_finished = false;
    while (text_.next(statement)) {
      if (is_finished)
        text_.fail(statement.line,
                   statement.word + " comes after FINI, the end of the program: remove it, or FINI");
      is_finished = statement.word == "FINI";
      if (!is_finished) take(statement);
    }
    return std::move(result_);
  }

 private:
  enum class FeedUnit { of_file, mm, inch };

  void take(const AptStatement& statement) {
    const std::string word = statement.word.substr(0, statement.word.find(','));
    const auto refuse = [&](const std::string& why) { text_.fail(statement.line, word + why); };
    const std::vector<std::string>& arguments = statement.arguments;
    const bool is_off = !arguments.empty() && arguments.front() == "OFF";
    const bool is_canceled = !arguments.empty() && arguments.front() == "NOMORE";
    if (word == "GOTO" || word == "FROM") return goTo(statement);
    if (word == "GODLTA") return goBy(statement);
    if (word == "TLAXIS") return setToolAxis(statement);
    if (word == "UNITS") return setUnits(statement);
    if (word == "FEDRAT") return setFeed(statement);
    if (word == "SPINDL") return setSpindle(statement);
    if (word == "RAPID") {
      is_rapid_ = true;
    } else if (isArc(word)) {
      refuse(" belongs to an arc, which is not supported: write the file with linear motions only");
    } else if (isOtherMotion(word) || (word == "CYCLE" && !is_off)) {
      refuse(" makes motions that are not supported: write the file as GOTO points");
    } else if (movesWhatFollows(word) && !is_canceled && !is_off) {
      refuse(
          " transforms the statements after it, which is not supported: write the file in the blisk's frame");
    } else if (word == "MSYS") {
      requireSameFrame(statement);
    } else if (word == "MODE") {
      if (std::ranges::find(arguments, "INCR") != arguments.end())
        refuse("/INCR: incremental points are not supported: write the file with absolute points");
    } else if (word == "MULTAX") {
      const bool is_known = arguments.empty() || isAmong(arguments.front(), {"ON", "OFF"});
      if (!is_known || arguments.size() > 1) refuse(" needs ON or OFF");
    } else if (loadsTool(word)) {
      noteTool(statement);
    } else if (!isOfNoMeaningHere(word) && !movesWhatFollows(word) && word != "CYCLE") {
      noteUnknown(word, statement.line);
    }
  }

  void noteUnknown(const std::string& word, std::size_t line) {
    const auto is_same = [&](const ClUnknown& unknown) { return unknown.word == word; };
    if (std::ranges::none_of(result_.unknown, is_same)) result_.unknown.push_back({word, line});
  }

  void noteTool(const AptStatement& statement) {
    const std::vector<std::string>& arguments = statement.arguments;
    const std::size_t at =
        !arguments.empty() && arguments.front() == "TOOL" ? 1 : 0;  // LOADTL/2 or LOAD/TOOL,2
    if (at >= arguments.size()) return;
    const std::string& tool = arguments[at];
    if (!tool_.empty() && tool != tool_ && result_.second_tool == 0) result_.second_tool = statement.line;
    tool_ = tool;
  }

  Vec3 vectorAt(const AptStatement& statement, std::size_t first) const {
    return {text_.number(statement, first), text_.number(statement, first + 1),
            text_.number(statement, first + 2)};
  }

  Vec3 axisAt(const AptStatement& statement, std::size_t first) const {
    const Vec3 axis = vectorAt(statement, first);
    const double length = axis.stableNorm();
    if (!(std::abs(length - 1.0) <= kAxisTolerance)) {
      text_.fail(statement.line, statement.word + ": the axis' length is " + std::to_string(length) +
                                     "; it must be within 0.001 of 1");
    }
    return axis / length;
  }

  /// The second axis, made perpendicular to the tool axis.
  Vec3 secondAxisAt(const AptStatement& statement, std::size_t first) const {
    const Vec3 axis = axisAt(statement, first);
    if (std::abs(axis.dot(tool_axis_)) > kAxisTolerance) {
      text_.fail(statement.line, statement.word + ": the second axis must be perpendicular to the tool axis");
    }
    return (axis - axis.dot(tool_axis_) * tool_axis_).normalized();
  }

  void goTo(const AptStatement& statement) {
    const std::size_t count = statement.arguments.size();
    if (count != 3 && count != 6 && count != 9) {
      text_.fail(
          statement.line,
          statement.word + " has " + std::to_string(count) +
              " values; it needs x,y,z, then optionally a tool axis i,j,k, then optionally a second axis");
    }
    const Vec3 position = unit_ * vectorAt(statement, 0);
    if (count >= 6) setToolAxis(statement, 3);
    if (count == 9) second_axis_ = secondAxisAt(statement, 6);
    add(position, statement);
  }

  void goBy(const AptStatement& statement) {
    const std::size_t count = statement.arguments.size();
    if (count != 3 && count != 6) {
      text_.fail(statement.line,
                 "GODLTA has " + std::to_string(count) + " values; it needs dx,dy,dz and optionally i,j,k");
    }
    if (result_.motions.empty()) text_.fail(statement.line, "GODLTA needs a point before it");
    const Vec3 step = unit_ * vectorAt(statement, 0);
    if (count == 6) setToolAxis(statement, 3);
    add(result_.motions.back().position + step, statement);
  }

  void add(const Vec3& position, const AptStatement& statement) {
    if (position.cwiseAbs().maxCoeff() > TriangleMesh::kMaxCoordinate) {
      text_.fail(statement.line, statement.word + ": the point must be at most 1e12 mm from the origin");
    }
    const bool is_start = statement.word == "FROM";
    const double feed = is_rapid_ || is_start ? 0.0 : feed_;
    if (!is_start) is_rapid_ = false;
    result_.motions.push_back(
        {position, tool_axis_, second_axis_, feed, statement.line, statement.last_line, unit_});
  }

  void setToolAxis(const AptStatement& statement) {
    if (statement.arguments.size() != 3) text_.fail(statement.line, "TLAXIS needs i,j,k");
    setToolAxis(statement, 0);
  }

  void setToolAxis(const AptStatement& statement, std::size_t first) {
    tool_axis_ = axisAt(statement, first);
    second_axis_.reset();
  }

  void setUnits(const AptStatement& statement) {
    const std::string unit = statement.arguments.size() == 1 ? statement.arguments.front() : std::string();
    const bool is_mm = isAmong(unit, {"MM", "MILLIMETERS", "MILLIMETRES"});
    const bool is_inch = isAmong(unit, {"INCHES", "INCH", "IN"});
    if (!is_mm && !is_inch) text_.fail(statement.line, "UNITS needs MM or INCHES");
    unit_ = is_mm ? 1.0 : kMmPerInch;
  }

  void setFeed(const AptStatement& statement) {
    constexpr double kGreatestFeed = 1e9;  // mm/min
    std::optional<double> value;
    for (std::size_t k = 0; k < statement.arguments.size(); ++k) {
      const std::string& argument = statement.arguments[k];
      const bool is_mode = isAmong(argument, {"PERMIN", "IPM", "MMPM", "PERREV", "IPR", "MMPR"});
      if (is_mode) {
        feed_unit_ = argument.starts_with("MM")  ? FeedUnit::mm
                     : argument.starts_with("I") ? FeedUnit::inch
                                                 : FeedUnit::of_file;
        feed_is_per_turn_ = argument.ends_with("R") || argument.ends_with("REV");
      } else if (value ||
                 std::isalpha(static_cast<unsigned char>(argument.empty() ? 'A' : argument.front()))) {
        text_.fail(statement.line, "FEDRAT needs a number, and PERMIN, IPM, MMPM, PERREV, IPR or MMPR; not " +
                                       inQuotes(argument));
      } else {
        value = text_.number(statement, k);
      }
    }
    if (!value) text_.fail(statement.line, "FEDRAT needs a number");
    const double unit = feed_unit_ == FeedUnit::mm ? 1.0 : feed_unit_ == FeedUnit::inch ? kMmPerInch : unit_;
    if (feed_is_per_turn_ && !turns_per_minute_) {
      text_.fail(statement.line, "FEDRAT per revolution needs a SPINDL in RPM before it");
    }
    feed_ = *value * unit * (feed_is_per_turn_ ? *turns_per_minute_ : 1.0);
    if (!(feed_ > 0.0 && feed_ <= kGreatestFeed)) {
      text_.fail(statement.line, "FEDRAT must be above 0 and at most 1e9 mm/min");
    }
    is_rapid_ = false;
  }

  void setSpindle(const AptStatement& statement) {
    const std::vector<std::string>& arguments = statement.arguments;
    const auto has = [&](const char* word) { return std::ranges::find(arguments, word) != arguments.end(); };
    if (has("SFM") || has("SMM")) {
      turns_per_minute_.reset();  // they depend on the tool's diameter
      return;
    }
    for (std::size_t k = 0; k < arguments.size(); ++k) {
      const bool is_number = arguments[k].find_first_of("0123456789") == 0 || arguments[k].starts_with('.');
      if (!is_number) continue;
      turns_per_minute_ = text_.number(statement, k);
      return;
    }
  }

  void requireSameFrame(const AptStatement& statement) {
    constexpr std::array<double, 9> kSame = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    bool is_same = statement.arguments.size() == kSame.size();
    for (std::size_t k = 0; is_same && k < kSame.size(); ++k) {
      is_same = std::abs(text_.number(statement, k) - kSame[k]) < 1e-6;
    }
    if (!is_same)
      text_.fail(statement.line, "MSYS is not the blisk's frame: write the file in the blisk's frame");
  }

  AptText text_;
  ClFile result_;
  double unit_ = 1.0;  // mm
  Vec3 tool_axis_ = Vec3::UnitZ();
  std::optional<Vec3> second_axis_;
  double feed_ = 0.0;  // mm/min
  FeedUnit feed_unit_ = FeedUnit::of_file;
  bool feed_is_per_turn_ = false;
  bool is_rapid_ = false;
  std::optional<double> turns_per_minute_;
  std::string tool_;  // of the last LOADTL or LOAD
};

}  // namespace

ClFile readClFile(const std::filesystem::path& file) {
  ClFile result = ClReader(file).read();
  if (result.motions.empty())
    throw std::runtime_error(file.string() + ": no motions: the file needs at least one GOTO");
  return result;
}

}  // namespace octoblisk::demos
