# The library for others: fpo::fpo by find_package, add_subdirectory and FetchContent, by pkg-config, and
# libfpo_c.so, which has the C functions of fpo_c.h alone and needs nothing but the system's libraries.

foreach(part geom fpo)
  set_target_properties(fpo_${part} PROPERTIES EXPORT_NAME ${part})
  target_include_directories(fpo_${part} INTERFACE $<INSTALL_INTERFACE:include/fpo>)
  target_compile_features(fpo_${part} PUBLIC cxx_std_20)
endforeach()
set_target_properties(fpo_fpo PROPERTIES OUTPUT_NAME fpo)

# The exact predicates are inline in part: whoever includes them compiles double operations as written, too.
target_compile_options(fpo_geom INTERFACE -ffp-contract=off)

add_library(fpo_c SHARED ${CMAKE_CURRENT_LIST_DIR}/fpo_c.cpp)
add_library(fpo::c ALIAS fpo_c)
target_link_libraries(fpo_c PRIVATE fpo_fpo)
target_include_directories(fpo_c INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:include/fpo>)
set_target_properties(fpo_c PROPERTIES EXPORT_NAME c VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}
  CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
if(NOT FPO_TOP_LEVEL AND NOT FPO_INSTALL)
  set_target_properties(fpo_c PROPERTIES EXCLUDE_FROM_ALL ON)
endif()

if(NOT FPO_INSTALL)
  return()
endif()

include(CMakePackageConfigHelpers)
include(GNUInstallDirs)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/fpo)
install(TARGETS fpo_geom fpo_fpo fpo_c EXPORT fpo-targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT fpo-targets NAMESPACE fpo:: DESTINATION ${package_folder})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/fpo ${PROJECT_SOURCE_DIR}/geom DESTINATION include/fpo FILES_MATCHING PATTERN *.h)

set(generated ${PROJECT_BINARY_DIR}/generated)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/fpo-config.cmake.in ${generated}/fpo-config.cmake
  INSTALL_DESTINATION ${package_folder} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${generated}/fpo-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${generated}/fpo-config.cmake ${generated}/fpo-config-version.cmake DESTINATION ${package_folder})
file(RELATIVE_PATH to_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
configure_file(${CMAKE_CURRENT_LIST_DIR}/fpo.pc.in ${generated}/fpo.pc @ONLY)
install(FILES ${generated}/fpo.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
