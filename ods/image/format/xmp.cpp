// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/format/xmp.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>

#include "ods/base/quote.h"

namespace ods {

bool is_gpano(const Attribute& attribute) {
  return attribute.name.starts_with("GPano:");
}

// --- writing ---------------------------------------------------------------------------------------------------------

std::string xml_unescaped(std::string text) {
  for (const auto& [name, letter] : {std::pair<std::string_view, char>{"&lt;", '<'},
                                     {"&gt;", '>'},
                                     {"&quot;", '"'},
                                     {"&apos;", '\''},
                                     {"&amp;", '&'}}) {  // last, so that its result is not decoded again
    for (size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
      text.replace(at, name.size(), 1, letter);
    }
  }
  return text;
}

static std::string text_of(const Attribute& attribute) {
  if (const int* i = std::get_if<int>(&attribute.value)) return fmt::format("{}", *i);
  if (const float* f = std::get_if<float>(&attribute.value)) return fmt::format("{}", *f);
  const std::string* s = std::get_if<std::string>(&attribute.value);
  return s ? *s : std::string();
}

namespace {

struct Namespace {
  std::string_view prefix, address;
};

}  // namespace

static constexpr Namespace kNamespaces[] = {
    {"GPano", "http://ns.google.com/photos/1.0/panorama/"},
    {"GImage", "http://ns.google.com/photos/1.0/image/"},
    {"xmpNote", "http://ns.adobe.com/xmp/note/"},
};

static const Namespace* namespace_of(const std::string& name) {
  for (const Namespace& each : kNamespaces) {
    if (name.starts_with(each.prefix) && name.substr(each.prefix.size(), 1) == ":") return &each;
  }
  return nullptr;
}

// The contents of an rdf:Description tag: declarations of the namespaces that `tag` lacks, then the properties.
static std::string written(const std::vector<Attribute>& properties, std::string_view tag) {
  std::string names, values;
  std::set<std::string_view> named;
  for (const Attribute& property : properties) {
    const Namespace* space = namespace_of(property.name);
    if (space == nullptr) continue;
    const std::string name = fmt::format(" xmlns:{}=", space->prefix);
    if (named.insert(space->prefix).second && tag.find(name) == std::string_view::npos) {
      names += fmt::format("{}\"{}\"", name, space->address);
    }
    values += fmt::format(" {}=\"{}\"", property.name, xml_text(text_of(property)));
  }
  return names + values;
}

std::string make_xmp_body(const std::vector<Attribute>& properties) {
  return fmt::format(
      "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\"><rdf:RDF xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">"
      "<rdf:Description rdf:about=\"\"{}/></rdf:RDF></x:xmpmeta>",
      written(properties, ""));
}

std::string make_xmp(const std::vector<Attribute>& properties) {
  return fmt::format("<?xpacket begin=\"\xEF\xBB\xBF\" id=\"W5M0MpCehiHzreSzNTczkc9d\"?>\n{}\n<?xpacket end=\"r\"?>",
                     make_xmp_body(properties));
}

std::string gpano_xmp(const std::vector<Attribute>& attributes) {
  std::vector<Attribute> properties;
  std::copy_if(attributes.begin(), attributes.end(), std::back_inserter(properties), is_gpano);
  return properties.empty() ? "" : make_xmp(properties);
}

// --- parsing ---------------------------------------------------------------------------------------------------------

static constexpr size_t kNone = std::string_view::npos;
static constexpr std::string_view kSpace = " \t\r\n";

namespace {

struct Tag {
  size_t begin = 0, end = 0;  // from its < to just after its >
  std::string_view name;      // includes the slash of an end tag
  bool is_empty = false;      // <name/>
};

}  // namespace

static bool skip_past(std::string_view xml, size_t& at, std::string_view mark) {
  at = xml.find(mark, at);
  if (at == kNone) return false;
  at += mark.size();
  return true;
}

// The next start or end tag at or after `at`. Sets `is_broken` if the text there is not XML.
static std::optional<Tag> next_tag(std::string_view xml, size_t at, bool& is_broken) {
  for (at = xml.find('<', at); at != kNone; at = xml.find('<', at)) {
    const std::string_view rest = xml.substr(at);
    const auto skips = [&](std::string_view begin, std::string_view end) {
      if (!rest.starts_with(begin)) return false;
      is_broken = is_broken || !skip_past(xml, at, end);
      return true;
    };
    if (skips("<!--", "-->") || skips("<![CDATA[", "]]>") || skips("<?", "?>") || skips("<!", ">")) {
      if (is_broken) return std::nullopt;
      continue;
    }
    size_t end = at + 1;
    for (char quote = 0; end < xml.size() && (quote != 0 || xml[end] != '>'); end++) {
      if (quote != 0) {
        if (xml[end] == quote) quote = 0;
      } else if (xml[end] == '"' || xml[end] == '\'') {
        quote = xml[end];
      }
    }
    is_broken = end >= xml.size();
    if (is_broken) return std::nullopt;
    const bool is_empty = xml[end - 1] == '/';
    const std::string_view inside = xml.substr(at + 1, end - at - 1 - (is_empty ? 1 : 0));
    return Tag{at, end + 1, inside.substr(0, inside.find_first_of(kSpace)), is_empty};
  }
  return std::nullopt;
}

namespace {

struct Name {
  size_t begin = 0, end = 0;  // including the spaces before and the value after it
  std::string_view name;
};

}  // namespace

// The attributes in a tag. Returns nullopt if they are not valid XML. Cutting one out leaves a valid tag.
static std::optional<std::vector<Name>> names_in(std::string_view xml, const Tag& tag) {
  xml = xml.substr(0, tag.end - (tag.is_empty ? 2 : 1));
  std::vector<Name> names;
  for (size_t at = tag.begin + 1 + tag.name.size();;) {
    const size_t begin = xml.find_first_not_of(kSpace, at);
    if (begin == kNone) return names;
    const size_t equals = xml.find('=', begin);
    const size_t open = equals == kNone ? kNone : xml.find_first_not_of(kSpace, equals + 1);
    if (begin == at || open == kNone || (xml[open] != '"' && xml[open] != '\'')) return std::nullopt;
    const size_t close = xml.find(xml[open], open + 1);
    std::string_view name = xml.substr(begin, equals - begin);
    name = name.substr(0, name.find_last_not_of(kSpace) + 1);
    if (close == kNone || name.find_first_of("\"'<> \t\r\n") != kNone) return std::nullopt;
    names.push_back({at, close + 1, name});
    at = close + 1;
  }
}

// The end of the element that this tag starts. Returns nullopt if it is not closed.
static std::optional<size_t> end_of_element(std::string_view xml, const Tag& tag) {
  if (tag.is_empty) return tag.end;
  bool is_broken = false;
  int depth = 1;
  for (size_t at = tag.end;;) {
    const std::optional<Tag> next = next_tag(xml, at, is_broken);
    if (!next) return std::nullopt;
    at = next->end;
    if (next->name == tag.name && !next->is_empty) depth++;
    if (next->name.starts_with('/') && next->name.substr(1) == tag.name) depth--;
    if (depth == 0) return at;
  }
}

static std::optional<std::string> without_gpano(std::string_view xmp) {
  bool is_broken = false;
  std::string kept;
  size_t done = 0;
  const auto leave_out = [&](size_t begin, size_t end) {
    kept += xmp.substr(done, begin - done);
    done = end;
  };
  for (size_t at = 0;;) {
    const std::optional<Tag> tag = next_tag(xmp, at, is_broken);
    if (is_broken) return std::nullopt;
    if (!tag) break;
    at = tag->end;
    if (tag->name.starts_with("GPano:")) {
      const std::optional<size_t> end = end_of_element(xmp, *tag);
      if (!end) return std::nullopt;
      leave_out(tag->begin, *end);
      at = *end;
      continue;
    }
    const std::optional<std::vector<Name>> names = names_in(xmp, *tag);
    if (!names) return std::nullopt;
    for (const Name& name : *names) {
      if (name.name.starts_with("GPano:")) leave_out(name.begin, name.end);
    }
  }
  leave_out(xmp.size(), xmp.size());
  return kept;
}

std::optional<std::string> replace_gpano(const std::string& xmp, const std::vector<Attribute>& properties) {
  std::optional<std::string> result = without_gpano(xmp);
  if (!result) return std::nullopt;
  bool is_broken = false;
  for (size_t at = 0;;) {
    const std::optional<Tag> tag = next_tag(*result, at, is_broken);
    if (!tag) return std::nullopt;
    at = tag->end;
    if (tag->name != "rdf:Description") continue;
    const std::string_view whole = std::string_view(*result).substr(tag->begin, tag->end - tag->begin);
    const std::string added = written(properties, whole);
    result->insert(tag->begin + 1 + tag->name.size(), added);
    return result;
  }
}

std::vector<Attribute> gpano_properties(const std::string& xmp) {
  std::set<std::string_view> names;
  bool is_broken = false;
  for (size_t at = 0;;) {
    const std::optional<Tag> tag = next_tag(xmp, at, is_broken);
    if (is_broken) return {};
    if (!tag) break;
    at = tag->end;
    if (tag->name.starts_with("GPano:")) names.insert(tag->name);
    const std::optional<std::vector<Name>> attributes = names_in(xmp, *tag);
    if (!attributes) return {};
    for (const Name& each : *attributes) {
      if (each.name.starts_with("GPano:")) names.insert(each.name);
    }
  }
  std::vector<Attribute> properties;
  for (std::string_view name : names) {
    properties.push_back({std::string(name), xml_unescaped(std::string(xmp_property(xmp, name)))});
  }
  return properties;
}

bool has_properties(const std::string& xmp) {
  bool is_broken = false;
  for (size_t at = 0;;) {
    const std::optional<Tag> tag = next_tag(xmp, at, is_broken);
    if (!tag) return is_broken;
    at = tag->end;
    const std::string_view name = tag->name.substr(tag->name.starts_with('/') ? 1 : 0);
    if (name != "x:xmpmeta" && name != "rdf:RDF" && name != "rdf:Description") return true;
    if (tag->name != "rdf:Description") continue;
    const std::optional<std::vector<Name>> names = names_in(xmp, *tag);
    if (!names) return true;
    for (const Name& each : *names) {
      if (each.name != "rdf:about" && each.name != "about" && !each.name.starts_with("xmlns")) return true;
    }
  }
}

std::string_view xmp_property(std::string_view xmp, std::string_view name) {
  for (size_t at = xmp.find(name); at != kNone; at = xmp.find(name, at + 1)) {
    size_t from = xmp.find_first_not_of(kSpace, at + name.size());
    if (from == kNone) break;
    if (xmp[from] == '>') return xmp.substr(from + 1, xmp.find('<', from) - from - 1);
    if (xmp[from] != '=') continue;
    from = xmp.find_first_of("\"'", from);
    if (from == kNone) break;
    return xmp.substr(from + 1, xmp.find(xmp[from], from + 1) - from - 1);
  }
  return {};
}

}  // namespace ods
