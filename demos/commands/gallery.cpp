// octoblisk gallery: runs scenes of moving concave bodies and writes a picture of each.
#include "gallery/gallery.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>

#include "command_line/help.h"
#include "command_line/options.h"
#include "commands/commands.h"
#include "io/quoted_text.h"

namespace octoblisk::demos {
namespace {

struct GalleryRequest {
  std::string scene = "all";
  std::string out;
  BuildOptions tree;
};

std::string sceneNames() {
  std::string names;
  for (const gallery::Exhibit& exhibit : gallery::exhibits()) names += exhibit.name + ", ";
  return names + "all";
}

void showAsked(const GalleryRequest& request) {
  makeFolder(request.out);
  bool is_known = false;
  for (const gallery::Exhibit& exhibit : gallery::exhibits()) {
    if (request.scene != "all" && request.scene != exhibit.name) continue;
    is_known = true;
    const std::vector<gallery::Number> numbers = gallery::show(exhibit, request.out, request.tree);
    std::cout << (std::filesystem::path(request.out) / (exhibit.name + ".png")).string() << ": at "
              << exhibit.shown.back() << " s";
    for (const gallery::Number& number : numbers) std::cout << ", " << number.name << ' ' << number.value;
    std::cout << std::endl;
  }
  if (!is_known) {
    throw std::invalid_argument(inQuotes(request.scene) + " is not a scene; the scenes are: " + sceneNames());
  }
}

}  // namespace

void addGalleryCommand(CLI::App& app, int&) {
  CLI::App& command = addSubcommand(app, "gallery");
  const auto request = std::make_shared<GalleryRequest>();
  command.add_option("scene", request->scene, "One of: " + sceneNames())
      ->type_name("SCENE")
      ->capture_default_str();
  addOut(command, request->out, "Folder for SCENE.png and SCENE.csv; created if missing", "DIR");
  addPartitionOption(command, request->tree);
  command.callback([request] { showAsked(*request); });
}

}  // namespace octoblisk::demos
