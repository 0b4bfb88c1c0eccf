#include "text/find_font.h"

#include <fontconfig/fontconfig.h>

#include <memory>
#include <mutex>
#include <set>

namespace tenon {

namespace {

struct Release {
  void operator()(FcPattern* pattern) const { FcPatternDestroy(pattern); }
};
using Pattern = std::unique_ptr<FcPattern, Release>;

std::string string_of(const Pattern& pattern, const char* property) {
  FcChar8* text = nullptr;
  if (FcPatternGetString(pattern.get(), property, 0, &text) != FcResultMatch) return {};
  return reinterpret_cast<const char*>(text);
}

// Whether the font is one of the family that the pattern names first, under any of its names.
bool is_of_family(const Pattern& font, const std::string& family) {
  FcChar8* name = nullptr;
  for (int i = 0; FcPatternGetString(font.get(), FC_FAMILY, i, &name) == FcResultMatch; ++i) {
    if (FcStrCmpIgnoreCase(name, reinterpret_cast<const FcChar8*>(family.c_str())) == 0) return true;
  }
  return false;
}

}  // namespace

Status add_font_file(const std::string& path) {
  // What is added twice stands there twice, for as long as the program runs: a scene may be read again and again.
  static std::mutex mutex;
  static std::set<std::string> added;
  const std::lock_guard lock(mutex);
  if (added.contains(path)) return success();
  if (!FcInit() || !FcConfigAppFontAddFile(nullptr, reinterpret_cast<const FcChar8*>(path.c_str()))) {
    return Error{ErrorKind::input, "'" + path + "' is no font; give a .ttf or .otf file", {}};
  }
  added.insert(path);
  return success();
}

Result<FontFile> find_font(const std::string& text) {
  const Error none{ErrorKind::machine, "no font is installed; on Debian, install fonts-liberation", {}};
  if (!FcInit()) return none;
  const Pattern pattern(FcNameParse(reinterpret_cast<const FcChar8*>(text.c_str())));
  if (!pattern) {
    return Error{ErrorKind::input,
                 "'" + text + "' names no font; write a family, and a style behind it: \"Liberation Sans:style=Bold\"",
                 {}};
  }
  const std::string family = string_of(pattern, FC_FAMILY);
  FcPatternAddBool(pattern.get(), FC_OUTLINE, FcTrue);
  FcPatternAddBool(pattern.get(), FC_SCALABLE, FcTrue);
  FcConfigSubstitute(nullptr, pattern.get(), FcMatchPattern);
  FcDefaultSubstitute(pattern.get());
  FcResult result = FcResultMatch;
  const Pattern font(FcFontMatch(nullptr, pattern.get(), &result));
  if (!font) return none;
  FontFile file{string_of(font, FC_FILE), 0, string_of(font, FC_FAMILY), string_of(font, FC_STYLE), true};
  if (file.path.empty()) return none;
  FcPatternGetInteger(font.get(), FC_INDEX, 0, &file.index);
  file.is_asked_for = family.empty() || is_of_family(font, family);
  return file;
}

}  // namespace tenon
