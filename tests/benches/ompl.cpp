// Plans paths with OMPL's RRTConnect and prints the time of each in microseconds and its length in metres: the planner
// that ERRT is compared with in tests/benches/errt.rs, which compiles and runs this.
//
// Arguments: a PGM image with a pixel for each millimetre, not 0 where a path may be; start x, start y, goal x, goal y in
// metres from the centre of its first pixel, y along its rows; number of plans; longest edge in metres.

#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/PathSimplifier.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

namespace ob = ompl::base;
namespace og = ompl::geometric;

constexpr double M_PER_PX = 0.001;
// A path is not expected to take longer.
constexpr double MOST_S = 10.0;
// A plan from one seed is the same each time: the shortest time is that of an idle machine.
constexpr int TIMES = 3;

int main(int count, char** words) {
    if (count != 8) {
        std::cerr << "usage: ompl IMAGE START_X START_Y GOAL_X GOAL_Y PLANS RANGE\n";
        return 2;
    }
    std::ifstream file(words[1], std::ios::binary);
    std::string magic;
    int columns = 0, rows = 0, most = 0;
    file >> magic >> columns >> rows >> most;
    file.get();
    const std::vector<char> free((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    if (magic != "P5" || free.size() != size_t(columns) * size_t(rows)) {
        std::cerr << words[1] << " is not a binary PGM image\n";
        return 2;
    }
    const auto number = [&](int index) { return std::atof(words[index]); };
    ompl::msg::setLogLevel(ompl::msg::LOG_NONE);

    for (unsigned seed = 1; seed <= unsigned(number(6)); ++seed) {
        double least_us = INFINITY, length_m = 0.0;
        for (int time = 0; time < TIMES; ++time) {
            ompl::RNG::setSeed(seed);
            auto space = std::make_shared<ob::RealVectorStateSpace>();
            space->addDimension(0.0, (columns - 1) * M_PER_PX);
            space->addDimension(0.0, (rows - 1) * M_PER_PX);
            og::SimpleSetup setup(space);
            setup.setStateValidityChecker([&](const ob::State* state) {
                const auto* at = state->as<ob::RealVectorStateSpace::StateType>();
                const int column = int(std::lround(at->values[0] / M_PER_PX));
                const int row = int(std::lround(at->values[1] / M_PER_PX));
                return free[size_t(row) * size_t(columns) + size_t(column)] != 0;
            });
            setup.getSpaceInformation()->setStateValidityCheckingResolution(M_PER_PX / space->getMaximumExtent());
            ob::ScopedState<> start(space), goal(space);
            start[0] = number(2), start[1] = number(3), goal[0] = number(4), goal[1] = number(5);
            setup.setStartAndGoalStates(start, goal);
            auto planner = std::make_shared<og::RRTConnect>(setup.getSpaceInformation());
            planner->setRange(number(7));
            setup.setPlanner(planner);
            setup.setup();

            const auto before = std::chrono::steady_clock::now();
            if (setup.solve(MOST_S) != ob::PlannerStatus::EXACT_SOLUTION) {
                std::cerr << "OMPL found no path\n";
                return 1;
            }
            og::PathSimplifier(setup.getSpaceInformation()).shortcutPath(setup.getSolutionPath());
            const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - before;
            least_us = std::min(least_us, took.count());
            length_m = setup.getSolutionPath().length();
        }
        std::cout << least_us << ' ' << length_m << '\n';
    }
}
