// The one place where stb_image is compiled: the three formats that core/image asks it for, from memory alone.
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_ONLY_HDR
#define STBI_NO_STDIO
// A side as long as the largest picture that core/image lets through, 200 megapixels in one row.
#define STBI_MAX_DIMENSIONS 200000000
#include <stb_image.h>
