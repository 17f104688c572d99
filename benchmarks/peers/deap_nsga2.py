#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""DEAP's NSGA-II with bounded SBX (20, 0.9) and polynomial mutation (20, 1/n). deap_nsga2.py PROBLEM SEED
prints CPU seconds, then the last population, a line of objectives each. Its parts are put together as its
documentation does for selTournamentDCD, for which the population is a multiple of four."""
import math
import random
import sys
import time

from deap import base, creator, tools

SCHEMES = [
    [250, 0, 600, 0, 300, 610, -250, 0, 590, 0, -300, 605],
    [350, 350, 600, -350, 350, 610, -350, -350, 590, 350, -350, 605],
    [500, 0, 620, 0, 680, 600, -500, 0, 610, 0, -680, 605],
    [220, 220, 580, 220, -220, 590, -220, 220, 595, -220, -220, 605],
    [600, 100, 610, 100, 600, 600, -600, -100, 590, -100, -600, 620],
]


def zdt1(x):
    g = 1 + 9 * sum(x[1:]) / (len(x) - 1)
    return x[0], g * (1 - math.sqrt(x[0] / g))


def four_targets(x):
    points = [x[0:3], x[3:6], x[6:9], x[9:12]]
    apart = sum(math.dist(points[i], points[j]) for i in range(4) for j in range(i + 1, 4))
    return sum(math.hypot(*p) for p in points) / 4, -apart


PROBLEMS = {
    # function, low, high, population, generations, first candidates
    "ZDT1": (zdt1, [0.0] * 30, [1.0] * 30, 100, 250, []),
    "paper": (four_targets, [-700, -700, 580] * 4, [700, 700, 620] * 4, 52, 100, SCHEMES),
}

name, seed = sys.argv[1], int(sys.argv[2])
function, low, high, size, generations, first = PROBLEMS[name]
random.seed(seed)
start = time.process_time()
creator.create("Fitness", base.Fitness, weights=(-1.0, -1.0))
creator.create("Individual", list, fitness=creator.Fitness)
population = [creator.Individual(float(v) for v in genes) for genes in first]
while len(population) < size:
    population.append(creator.Individual(random.uniform(a, b) for a, b in zip(low, high)))
for one in population:
    one.fitness.values = function(one)
population = tools.selNSGA2(population, size, nd="log")
for _ in range(generations):
    children = [creator.Individual(one) for one in tools.selTournamentDCD(
        [p for p in population], size)]
    for a, b in zip(children[::2], children[1::2]):
        if random.random() <= 0.9:
            tools.cxSimulatedBinaryBounded(a, b, 20.0, low, high)
        tools.mutPolynomialBounded(a, 20.0, low, high, 1 / len(low))
        tools.mutPolynomialBounded(b, 20.0, low, high, 1 / len(low))
    for child in children:
        child.fitness.values = function(child)
    population = tools.selNSGA2(population + children, size, nd="log")
print(time.process_time() - start)
for one in population:
    print(*one.fitness.values)
