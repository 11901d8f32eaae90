# The documents of the packages: licence, changelog, and the man page that demos/CMakeLists.txt makes.
# octoblisk_pack(FILE NAME): compresses FILE to NAME.gz in the build folder. The bytes do not depend on the time.
find_program(OCTOBLISK_GZIP gzip REQUIRED)
function(octoblisk_pack file name)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  execute_process(COMMAND ${OCTOBLISK_GZIP} --best --no-name --stdout ${file}
    OUTPUT_FILE ${PROJECT_BINARY_DIR}/${name}.gz COMMAND_ERROR_IS_FATAL ANY)
endfunction()
octoblisk_pack(${PROJECT_SOURCE_DIR}/CHANGELOG.md changelog)
configure_file(${PROJECT_SOURCE_DIR}/cmake/changelog.Debian.in ${PROJECT_BINARY_DIR}/changelog.Debian @ONLY)
octoblisk_pack(${PROJECT_BINARY_DIR}/changelog.Debian changelog.Debian)

# octoblisk_install_documents(COMPONENT PACKAGE): installs the documents that Debian requires in every package.
function(octoblisk_install_documents component package)
  set(folder ${CMAKE_INSTALL_DATAROOTDIR}/doc/${package})
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${folder} RENAME copyright COMPONENT ${component})
  install(FILES ${PROJECT_BINARY_DIR}/changelog.gz ${PROJECT_BINARY_DIR}/changelog.Debian.gz
    DESTINATION ${folder} COMPONENT ${component})
endfunction()
octoblisk_install_documents(development liboctoblisk-dev)
if(BUILD_SHARED_LIBS)
  octoblisk_install_documents(libraries liboctoblisk${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
endif()
if(OCTOBLISK_BUILD_DEMOS)
  octoblisk_install_documents(command octoblisk)
  install(FILES ${PROJECT_BINARY_DIR}/octoblisk.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT command)
endif()
