get_filename_component(HEWN_SOURCE_DIR ${CMAKE_CURRENT_LIST_DIR}/.. ABSOLUTE)

# One interface target carries the language level and the warnings to every layer.
add_library(hewn_settings INTERFACE)
target_compile_features(hewn_settings INTERFACE cxx_std_20)
# No contraction: the same source must give the same bits on every compiler and device.
target_compile_options(hewn_settings INTERFACE
  "$<$<COMPILE_LANGUAGE:CXX>:-ffp-contract=off;-Wall;-Wextra;-Wconversion;-Wshadow;-Wno-sign-conversion>")
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # False alarm on `"text" + string` (GCC bug 105651).
  target_compile_options(hewn_settings INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Wno-restrict>)
endif()
if(HEWN_WERROR)
  target_compile_options(hewn_settings INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Werror>)
endif()
target_include_directories(hewn_settings INTERFACE ${HEWN_SOURCE_DIR})
target_link_libraries(hewn_settings INTERFACE Threads::Threads)

# The asan and tsan presets set this: the sanitizers for every target, and assertions with them.
set(HEWN_SANITIZER "" CACHE STRING "Sanitizers to build with, e.g. address,undefined or thread")
if(HEWN_SANITIZER)
  target_compile_options(hewn_settings INTERFACE
    "$<$<COMPILE_LANGUAGE:CXX>:-fsanitize=${HEWN_SANITIZER};-fno-omit-frame-pointer;-fno-sanitize-recover=all>")
  target_link_options(hewn_settings INTERFACE -fsanitize=${HEWN_SANITIZER})
  target_compile_definitions(hewn_settings INTERFACE HEWN_ASSERTIONS HEWN_SANITIZED)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # GCC's manual warns of false alarms where the sanitizers' own code hides assignments.
    target_compile_options(hewn_settings INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Wno-maybe-uninitialized>)
  endif()
endif()

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)

find_program(HEWN_CCACHE ccache)
if(HEWN_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${HEWN_CCACHE})
endif()

# hewn_layer(NAME SOURCES ... LINKS ...): one static library per layer with only its real
# dependencies, so that a layering violation fails to link.
function(hewn_layer name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS;SYSTEM_LINKS" ${ARGN})
  add_library(hewn_${name} STATIC ${ARG_SOURCES})
  target_link_libraries(hewn_${name} PUBLIC hewn_settings ${ARG_LINKS} PRIVATE ${ARG_SYSTEM_LINKS})
endfunction()

# hewn_module(NAME SOURCES ... LINKS ...): libhewn-NAME.so beside the programs, for what is loaded when
# it is first needed (core/base/module.h). It uses nothing of the layers but their headers.
function(hewn_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS" ${ARGN})
  add_library(hewn_${name} MODULE ${ARG_SOURCES})
  set_target_properties(hewn_${name} PROPERTIES
    OUTPUT_NAME hewn-${name} CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON
    LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
  target_link_libraries(hewn_${name} PRIVATE hewn_settings ${ARG_LINKS})
  target_link_options(hewn_${name} PRIVATE LINKER:--no-undefined)
endfunction()

# hewn_test(NAME LABELS ... SOURCES ... LINKS ...): one doctest executable. Add the label `unit`,
# `property`, `golden`, `openscad`, `session`, `gpu` or `fuzz`.
function(hewn_test name)
  cmake_parse_arguments(ARG "" "" "LABELS;SOURCES;LINKS" ${ARGN})
  add_executable(${name} ${HEWN_SOURCE_DIR}/tests/test_main.cpp ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE hewn_settings ${ARG_LINKS} doctest::doctest)
  target_compile_definitions(${name} PRIVATE
                             HEWN_TEST_DATA="${HEWN_SOURCE_DIR}/tests/data"
                             HEWN_ASSETS="${HEWN_SOURCE_DIR}/assets"
                             HEWN_BINARY_DIR="${PROJECT_BINARY_DIR}")
  add_test(NAME ${name} COMMAND ${name})
  set_tests_properties(${name} PROPERTIES LABELS "${ARG_LABELS}" TIMEOUT 900
                       SKIP_REGULAR_EXPRESSION "SKIPPED:"
                       ENVIRONMENT "${HEWN_TEST_ENVIRONMENT}")
endfunction()

# Libraries of the distribution are not instrumented; their false alarms are listed by name.
set(HEWN_TEST_ENVIRONMENT "")
if(HEWN_SANITIZER)
  set(suppressions ${HEWN_SOURCE_DIR}/tests/sanitizers)
  set(HEWN_TEST_ENVIRONMENT
      "TSAN_OPTIONS=suppressions=${suppressions}/tsan.supp ignore_noninstrumented_modules=1"
      "LSAN_OPTIONS=suppressions=${suppressions}/lsan.supp print_suppressions=0"
      "ASAN_OPTIONS=detect_stack_use_after_return=1"
      "UBSAN_OPTIONS=print_stacktrace=1"
      "HEWN_KEY_DELAY=400")
endif()
