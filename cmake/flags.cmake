# The flags of the project's own code: warnings are errors, one architecture, and no
# contraction of a*b+c, so that a result does not depend on what the optimiser fused.
# Complex products and quotients by Fortran's rules: scaled as in C, without C's search for infinities.
add_library(grimaldi_flags INTERFACE)
target_compile_options(grimaldi_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Werror
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict> # g++ 12 warns of std::string's own code (GCC bug 105651)
  -march=${GRIMALDI_ARCH} -ffp-contract=off -fcx-fortran-rules)
target_include_directories(grimaldi_flags INTERFACE ${PROJECT_SOURCE_DIR})
if(GRIMALDI_SANITIZE)
  # With sanitizers g++ 12 warns of the standard library's own temporaries.
  target_compile_options(grimaldi_flags INTERFACE -Wno-maybe-uninitialized -fsanitize=${GRIMALDI_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(grimaldi_flags INTERFACE -fsanitize=${GRIMALDI_SANITIZE})
endif()

# One static library for a folder: every source in it, alias grimaldi::NAME.
function(grimaldi_library name)
  file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*.cpp" "${CMAKE_CURRENT_SOURCE_DIR}/*.h")
  add_library(grimaldi_${name} STATIC ${sources})
  add_library(grimaldi::${name} ALIAS grimaldi_${name})
  set_target_properties(grimaldi_${name} PROPERTIES LINKER_LANGUAGE CXX)
  target_link_libraries(grimaldi_${name} PUBLIC ${ARGN} PRIVATE grimaldi_flags)
  target_include_directories(grimaldi_${name} PUBLIC ${PROJECT_SOURCE_DIR})
endfunction()
