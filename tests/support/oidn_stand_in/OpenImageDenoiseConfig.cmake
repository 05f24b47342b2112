# A stand-in of Open Image Denoise for machines that have no package of it: what of its C++ API Candela uses, around an
# identity filter that remembers what it was given. For tests alone; see tests/oidn.
add_library(OpenImageDenoise INTERFACE IMPORTED)
target_include_directories(OpenImageDenoise INTERFACE ${CMAKE_CURRENT_LIST_DIR})
