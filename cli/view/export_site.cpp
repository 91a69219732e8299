// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/view/export_site.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/console/console.h"
#include "ods/base/quote.h"
#include "ods/files/atomic_file.h"
#include "ods/files/atomic_folder.h"
#include "ods/files/file_input.h"
#include "ods/view/bundle.h"
#include "ods/view/page.h"

using ods::ViewItem;

namespace {

constexpr uint64_t kMaxInlinedBytes = uint64_t{256} << 20;  // bytes of a file: browsers limit the length of a text

void copy_file(const std::string& from, const std::string& to) {
  const ods::FileInput file(from);
  ods::AtomicFile copy(to);
  file.copy(0, file.size(), copy);
  copy.commit();
}

// The eyes as JPEGs where browsers do not read the file; its light, which joins `files`; its poster and its thumbnail.
void write_pictures(const ViewItem& item, size_t index, std::vector<std::string>& files, const std::string& folder) {
  if (!has_stills(item)) return;
  const ods::StoredPicture picture = open_shown(item);
  const size_t eyes = files.size();
  if (has_light(item)) {
    const std::string light = ods::item_file(index, ods::kLightFile);
    ods::write_file(folder + "/" + light, light_png(picture));
    files.push_back(light);
  }
  for (size_t i = 0; i < eyes && !item.has_own_file; i++) {
    ods::write_file(folder + "/" + files[i], eye_jpeg(picture, picture.eyes[i].eye, {}));
  }
  ods::write_file(folder + "/" + ods::item_file(index, ods::kPosterFile), poster_jpeg(picture));
  ods::write_file(folder + "/" + ods::item_file(index, ods::kThumbnailFile), thumbnail_jpeg(item));
}

// For pages from disk.
void write_script_beside(const std::string& path) {
  const ods::FileInput file(path);
  if (file.size() <= kMaxInlinedBytes) {
    return ods::write_file(path + ".js", ods::script_of_file(path, file.read(0, file.size())));
  }
  std::filesystem::remove(path + ".js");
  note(fmt::format("'{}' is too large for a page from disk: it needs a web server",
                   std::filesystem::path(path).filename().native()));
}

std::string poster_tags(const std::string& poster) {
  return fmt::format(
      "\n<meta property=\"og:image\" content=\"{}\">\n"
      "<meta name=\"twitter:card\" content=\"summary_large_image\">",
      poster);
}

// The page with its title, what a link to it shows, and what is there without scripts.
std::string index_page(const std::vector<ViewItem>& items, const PageTexts& texts) {
  std::string page(ods::find_page_file("index.html")->data);
  if (items.empty()) return page;
  const auto replace = [&page](std::string_view part, const std::string& text) {
    page.replace(page.find(part), part.size(), text);
  };
  const ViewItem& first = items.front();
  const std::string name = std::filesystem::path(first.name).stem().native();
  const std::string& named = first.title.empty() ? name : first.title;
  const std::string about = ods::xml_text(first.notes.caption.empty() ? named : first.notes.caption);
  const std::string title = texts.title.empty() ? about : ods::xml_text(texts.title);
  const std::string poster = ods::item_file(0, ods::kPosterFile), file = item_files(first, 0).front();
  replace(R"(lang="en")", fmt::format(R"(lang="{}")", texts.language));
  replace("<title>Omnistereo</title>",
          fmt::format("<title>{0}</title>\n<meta name=\"description\" content=\"{1}\">\n"
                      "<meta name=\"theme-color\" content=\"#1a1a1a\">\n"
                      "<meta property=\"og:type\" content=\"website\">\n<meta property=\"og:title\" content=\"{0}\">\n"
                      "<meta property=\"og:description\" content=\"{1}\">{2}",
                      title, about, has_stills(first) ? poster_tags(poster) : ""));
  if (!has_stills(first)) return page;
  replace("<noscript>The picture needs JavaScript.</noscript>",
          fmt::format("<noscript><a href=\"{}\"><img src=\"{}\" alt=\"{}\" width=\"100%\"></a></noscript>", file,
                      poster, title));
  return page;
}

void write_page(const std::vector<ViewItem>& items, const PageTexts& texts, const std::string& folder) {
  ods::write_file(folder + "/index.html", index_page(items, texts));
  for (const char* const name : {"style.css", "player.css", "example.html", "example.css", "example.js"}) {
    ods::write_file(folder + "/" + name, std::string(ods::find_page_file(name)->data));
  }
  for (const char* const entry : {"main.js", "stereo-360.js"}) {
    ods::write_file(folder + "/" + entry, ods::bundle(entry));
  }
  for (const std::string_view later : ods::kLaterScripts) {
    ods::write_file(fmt::format("{}/{}", folder, later), ods::bundle_later(later, ods::PageHost::kFolder));
  }
}

// The page and view.json come last: they list the other files.
void write_site(const std::vector<ViewItem>& items, const PageTexts& texts, const ods::Tour* tour,
                const std::string& folder) {
  for (size_t i = 0; i < items.size(); i++) {
    std::vector<std::string> files = item_files(items[i], i);
    if (items[i].has_own_file)
      copy_file(items[i].path, folder + "/" + files[0]);
    else if (items[i].is_for_apple)
      copy_file(items[i].path, folder + "/" + system_file(items[i], i));
    if (!items[i].fallback.empty()) {
      files.push_back(fallback_file(items[i], i));
      copy_file(items[i].fallback, folder + "/" + files.back());
    }
    write_pictures(items[i], i, files, folder);
    for (size_t k = 0; k < items[i].objects.size(); k++) {
      files.push_back(ods::object_file(i, k));
      ods::write_file(folder + "/" + files.back(), *items[i].objects[k].glb);
    }
    if (items[i].stage) {
      files.push_back(ods::item_file(i, ods::kDepthFile));
      ods::write_file(folder + "/" + files.back(), items[i].stage->depth_png);
    }
    if (has_preview(items[i], false)) {
      files.push_back(ods::item_file(i, ods::kPreviewFile));
      ods::write_file(folder + "/" + files.back(), preview_jpeg(items[i]));
    }
    for (const std::string& file : files) write_script_beside(folder + "/" + file);
  }
  if (tour && tour->plan) copy_file(tour->plan->image, folder + "/" + plan_file(*tour->plan));
  write_page(items, texts, folder);
  ods::write_file(folder + "/view.json", view_json(items, false, {}, tour));
  write_script_beside(folder + "/view.json");
}

// Messages name files of the draft by their final names.
std::string with_final_names(const ods::AtomicFolder& site, std::string text) {
  for (size_t at = 0; (at = text.find(site.draft(), at)) != std::string::npos; at += site.path().size()) {
    text.replace(at, site.draft().size(), site.path());
  }
  return text;
}

}  // namespace

std::vector<std::string> page_languages() {
  constexpr std::string_view kTranslations = "translations-";  // and the language: translations-de.js
  std::vector<std::string> languages = {"en"};
  for (const ods::PageFile& file : ods::page_files()) {
    if (file.name.starts_with(kTranslations)) languages.emplace_back(file.name.substr(kTranslations.size(), 2));
  }
  std::ranges::sort(languages);
  return languages;
}

std::string export_site(const std::vector<ViewItem>& items, const std::string& folder, const PageTexts& texts,
                        const ods::Tour* tour) {
  ods::AtomicFolder site(folder);
  try {
    write_site(items, texts, tour, site.draft());
    site.commit();
  } catch (const ods::Error& error) {
    throw ods::Error(error.kind(), with_final_names(site, error.what()));
  }
  return folder + "/view.json";
}
