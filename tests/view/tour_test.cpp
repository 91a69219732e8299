// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/view/tour.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "ods/base/error.h"
#include "ods/picture/metadata/sidecar.h"
#include "tests/support/temporary_folder.h"

using namespace ods;

namespace {

class TourFile : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"a_360_TB.jpg", "b.jpg", "c.jpg"}) folder_.write(name, "a picture");
  }

  Tour read(const std::string& json) const {
    folder_.write("tour.json", json);
    return read_tour(folder_.path("tour.json"));
  }

  // Returns the error of a tour; empty if it has none.
  std::string fault(const std::string& json) const {
    try {
      read(json);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput);
      return error.what();
    }
    return "";
  }

  void expect_fault(const std::string& json, const std::string& part) const {
    const std::string said = fault(json);
    EXPECT_NE(said.find(part), std::string::npos) << json << "\n" << said;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    EXPECT_NE(said.find("tour.json"), std::string::npos) << said;
  }

  TemporaryFolder folder_;
};

TEST_F(TourFile, IsRead) {
  const Tour tour = read(R"({"floor": 0.5, "height": 1.4, "panoramas": [
    {"file": "a_360_TB.jpg", "title": "A", "text": "x", "place": [1, 2, 3], "heading": -30,
     "links": ["b", {"to": "third", "yaw": 10, "pitch": 5, "distance": 2}]},
    {"file": "b.jpg", "place": [0, 5, 0], "floor": 3.5},
    {"file": "c.jpg", "name": "third", "place": [9, 2, 0]}]})");
  ASSERT_EQ(tour.panoramas.size(), 3u);
  const TourStop& a = tour.panoramas[0];
  EXPECT_EQ(a.file, folder_.path("a_360_TB.jpg"));
  EXPECT_EQ(a.name, "a") << "the words of the format are left out";
  EXPECT_EQ(a.place, vec3(1, 2, 3));
  EXPECT_EQ(a.heading, -30.0f);
  EXPECT_EQ(a.floor, 0.5f);
  ASSERT_EQ(a.links->size(), 2u);
  EXPECT_EQ((*a.links)[0].to, 1u);
  EXPECT_EQ((*a.links)[1].to, 2u);
  EXPECT_EQ((*a.links)[1].yaw, 10.0f);
  EXPECT_FALSE((*a.links)[0].yaw);
  EXPECT_EQ(tour.panoramas[1].title, "b");
  EXPECT_EQ(tour.panoramas[1].floor, 3.5f);
  EXPECT_FALSE(tour.panoramas[1].links);
  const Json json = tour_json(tour);
  EXPECT_EQ(json["panoramas"][0]["links"][1]["to"], "third");
  EXPECT_EQ(json["panoramas"][0]["place"], Json({1, 2, 3}));
  EXPECT_FALSE(json["panoramas"][1].contains("links") || json["panoramas"][1].contains("heading"));
}

// The sidecar of a rendered picture knows where the camera was; what the tour says counts.
TEST_F(TourFile, PlacesComeFromTheCameras) {
  Sidecar sidecar;
  sidecar.camera.position = {1.5f, 1.7f, -2.0f};
  sidecar.camera.yaw = 40.0f;
  save_sidecar(sidecar, folder_.path("a_360_TB.camera.json"));
  save_sidecar(sidecar, folder_.path("b.camera.json"));
  const Tour tour = read(R"({"panoramas": ["a_360_TB.jpg", {"file": "b.jpg", "place": [0, 1, 0]}]})");
  EXPECT_EQ(tour.panoramas[0].place, vec3(1.5f, 1.7f, -2.0f));
  EXPECT_EQ(tour.panoramas[0].heading, 40.0f);
  EXPECT_EQ(tour.panoramas[1].place, vec3(0, 1, 0));
}

TEST_F(TourFile, WhatIsWrongIsSaid) {
  expect_fault("{", "is not JSON");
  expect_fault(R"({"panoramas": []})", "panoramas must be a list of 1 to 500");
  expect_fault(R"({"panoramas": ["no.jpg"]})", "panoramas.0.file 'no.jpg' does not exist");
  expect_fault(R"({"panoramas": [{"file": "."}]})", "panoramas.0.file");
  expect_fault(R"({"panoramas": ["b.jpg", "c.jpg"]})", "panoramas.0 ('b') has no place");
  expect_fault(R"({"panoramas": [{"file": "b.jpg", "links": ["c"]}, {"file": "c.jpg", "links": []}]})",
               "panoramas.0 ('b') has no place");
  expect_fault(R"({"panoramas": ["b.jpg", {"file": "c.jpg", "name": "b"}]})", "two panoramas are called 'b'");
  expect_fault(R"({"panoramas": [{"file": "b.jpg", "links": ["cc"]}, {"file": "c.jpg"}]})",
               "panoramas.0.links.0.to leads nowhere: no panorama is called 'cc'; did you mean 'c'?");
  expect_fault(R"({"panoramas": [{"file": "b.jpg", "links": ["b"]}]})", "leads to its own panorama");
  expect_fault(R"({"panoramas": [{"file": "b.jpg", "titel": "B"}]})", "unknown key 'panoramas.0.titel'");
  expect_fault(R"({"panoramas": [{"file": "b.jpg", "place": [0, 0, 0]}]})", "floor must be below the camera");
  expect_fault(R"({"panoramas": [{"file": "b.jpg", "on_plan": [1, 2]}]})", "on_plan needs a plan");
  EXPECT_NE(fault(R"({"panoramas": ["b.jpg"], "plan": {"image": "c.jpg"}})").find("c.jpg': it is not one of png"),
            std::string::npos);
  expect_fault(R"({"panoramas": ["b.jpg"], "plan": {"image": "tour.json"}})", "must be a PNG, a JPEG or a WebP");
  EXPECT_EQ(fault(R"({"panoramas": ["b.jpg"]})"), "") << "one panorama needs no place";
  EXPECT_EQ(
      fault(R"({"panoramas": [{"file": "b.jpg", "links": [{"to": "c", "yaw": 5}]}, {"file": "c.jpg", "links": []}]})"),
      "");
}

TEST_F(TourFile, NamesOfOtherFilesAreNoTours) {
  EXPECT_TRUE(names_tour("a/Tour.JSON"));
  for (const char* name : {"a.camera.json", "a.notes.json", "a.objects.json", "a.jpg"}) EXPECT_FALSE(names_tour(name));
}

}  // namespace
