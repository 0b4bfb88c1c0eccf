#include "drawing/dxf_groups.h"

#include "base/text_scanner.h"

namespace tenon {

namespace {

// The codes whose values are numbers, of those that drawings need: coordinates, sizes, angles, counts, directions.
bool has_number(int code) {
  return (code >= 10 && code <= 79) || (code >= 210 && code <= 239);
}

}  // namespace

Result<std::vector<DxfGroup>> read_dxf_groups(const InputFile& file) {
  if (file.bytes.starts_with("AutoCAD Binary DXF")) {
    return at_file(file.path, "this is binary DXF; save it as text (ASCII)");
  }
  TextScanner scanner(file.path, file.bytes);
  std::vector<DxfGroup> groups;
  while (scanner.next_line()) {
    const std::string_view word = scanner.rest();
    const auto code = to_integer(word);
    if (!code || *code < -10 || *code > 1100) {
      // Files may end in an empty line.
      if (word.empty() && !scanner.next_line()) break;
      return scanner.error("a group code is expected here, a number from 0 to 1071");
    }
    if (!scanner.next_line()) return scanner.error("the file ends behind a group code; it is cut off");
    DxfGroup group{static_cast<int>(*code), scanner.rest(), 0, scanner.line()};
    if (has_number(group.code)) {
      const auto number = to_number(group.value);
      if (!number)
        return scanner.error("a finite number is expected here, the value of group " + std::to_string(*code));
      group.number = *number;
    }
    groups.push_back(group);
  }
  if (groups.empty()) return at_file(file.path, "the file is empty; a DXF file is expected");
  return groups;
}

std::vector<DxfEntity> entities_of(const std::vector<DxfGroup>& groups) {
  std::vector<DxfEntity> entities;
  for (std::size_t i = 0; i < groups.size();) {
    std::size_t end = i + 1;
    while (end < groups.size() && groups[end].code != 0) ++end;
    if (groups[i].code == 0)
      entities.push_back({groups[i].value, groups[i].line, {groups.data() + i + 1, end - i - 1}});
    i = end;
  }
  return entities;
}

}  // namespace tenon
