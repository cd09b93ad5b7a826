find_program(CCACHE ccache)
if(CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()

add_library(quadrille_flags INTERFACE)
# Contraction into fused multiply-adds would make results depend on the compiler's choices.
# GCC 12 warns falsely of overlapping strings (-Wrestrict) and of unset parts of Eigen's vectors.
target_compile_options(quadrille_flags INTERFACE -Wall -Wextra -Wshadow=local
                       -Wno-missing-field-initializers -Wno-restrict -Wno-maybe-uninitialized
                       -ffp-contract=off $<$<BOOL:${QUADRILLE_WERROR}>:-Werror>)

# A room is a static library of all its sources. Its public headers live in include/, so an include
# of a room that is not linked does not compile.
function(quadrille_room name)
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/src/*.cpp)
  add_library(quadrille_${name} STATIC ${sources})
  add_library(quadrille::${name} ALIAS quadrille_${name})
  target_include_directories(quadrille_${name} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>)
  target_link_libraries(quadrille_${name} PRIVATE $<BUILD_INTERFACE:quadrille_flags>)
  set_target_properties(quadrille_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
endfunction()
