# The octoblisk command with its subcommand check alone, for systems without the libraries of the others.
octoblisk_require(CLI11 libcli11-dev CONFIG)
octoblisk_require(assimp libassimp-dev CONFIG)
octoblisk_require(Threads libc6-dev)
set(check_files octoblisk_check
  command_line/command_line command_line/help command_line/manual command_line/options command_line/units_option
  commands/check commands/check_summary
  io/csv_table io/mesh_file io/mesh_file_check io/new_file io/progress_bar
  models/defect_words models/welded_surface
  study/launch study/merge_parts study/node_inputs study/part_text study/ranks_alone study/run_study
  study/stop_signal study/study study/study_journal
  toolpath/pose_check toolpath/pose_file)
list(TRANSFORM check_files REPLACE "(.+)" "${PROJECT_SOURCE_DIR}/demos/\\1.cpp")
add_executable(octoblisk ${check_files})
target_include_directories(octoblisk PRIVATE ${PROJECT_SOURCE_DIR}/demos)
target_compile_definitions(octoblisk PRIVATE OCTOBLISK_VERSION="${PROJECT_VERSION}"
  OCTOBLISK_HELP="${PROJECT_SOURCE_DIR}/demos/command_line/help")
target_link_libraries(octoblisk PRIVATE
  octoblisk-core-private assimp::assimp CLI11::CLI11 Threads::Threads octoblisk-warnings)
