% SPDX-License-Identifier: Apache-2.0
% The paper's Tables 3 to 7 as they are printed, loop for loop, on the problem of its Section 4.2: four targets,
% the five schemes of Table 9 and random layouts at first. paper_nsga2.m POPULATION GENERATIONS SEED prints CPU
% seconds, then the last population, a line of objectives each.
1;

function f = objectives(x)
  p = reshape(x, 3, 4)';
  f = [0, 0];
  for i = 1:4
    f(1) = f(1) + norm(p(i, :)) / 4;
    for j = i + 1:4
      f(2) = f(2) - norm(p(i, :) - p(j, :));
    end
  end
end

function rank = sort_fronts(f)  % Table 3
  n = rows(f);
  dominated = cell(n, 1);
  count = zeros(n, 1);
  for p = 1:n
    for q = 1:n
      if all(f(p, :) <= f(q, :)) && any(f(p, :) < f(q, :))
        dominated{p}(end + 1) = q;
      elseif all(f(q, :) <= f(p, :)) && any(f(q, :) < f(p, :))
        count(p) = count(p) + 1;
      end
    end
  end
  rank = zeros(n, 1);
  front = find(count == 0)';
  k = 1;
  while ! isempty(front)
    next = [];
    for p = front
      rank(p) = k;
      for q = dominated{p}
        count(q) = count(q) - 1;
        if count(q) == 0
          next(end + 1) = q;
        end
      end
    end
    front = next;
    k = k + 1;
  end
end

function d = crowding(f)  % Table 4
  l = rows(f);
  d = zeros(l, 1);
  for m = 1:2
    [value, order] = sort(f(:, m));
    d(order(1)) = Inf;
    d(order(l)) = Inf;
    range = value(l) - value(1);
    for i = 2:l - 1
      if range > 0
        d(order(i)) = d(order(i)) + (value(i + 1) - value(i - 1)) / range;
      end
    end
  end
end

function [a, b] = cross(pa, pb, low, high)  % Table 5
  a = pa;
  b = pb;
  if rand() > 0.9
    return
  end
  for j = 1:numel(pa)
    u = rand();
    if u <= 0.5
      gamma = (2 * u) ^ (1 / 21);
    else
      gamma = (1 / (2 * (1 - u))) ^ (1 / 21);
    end
    a(j) = min(max(0.5 * ((1 + gamma) * pa(j) + (1 - gamma) * pb(j)), low(j)), high(j));
    b(j) = min(max(0.5 * ((1 - gamma) * pa(j) + (1 + gamma) * pb(j)), low(j)), high(j));
  end
end

function x = mutate(x, low, high)  % Table 6
  for j = 1:numel(x)
    if rand() <= 1 / numel(x)
      u = rand();
      if u < 0.5
        sigma = (2 * u) ^ (1 / 21) - 1;
      else
        sigma = 1 - (2 * (1 - u)) ^ (1 / 21);
      end
      x(j) = min(max(x(j) + sigma * (high(j) - low(j)), low(j)), high(j));
    end
  end
end

function winner = tournament(rank, distance)
  a = randi(numel(rank));
  b = randi(numel(rank));
  winner = a;
  if rank(b) < rank(a) || (rank(b) == rank(a) && distance(b) > distance(a))
    winner = b;
  end
end

arguments = argv();
n = str2double(arguments{1});
generations = str2double(arguments{2});
rand("twister", str2double(arguments{3}));
low = repmat([-700, -700, 580], 1, 4);
high = repmat([700, 700, 620], 1, 4);
start = cputime();
x = [250 0 600 0 300 610 -250 0 590 0 -300 605; 350 350 600 -350 350 610 -350 -350 590 350 -350 605;
     500 0 620 0 680 600 -500 0 610 0 -680 605; 220 220 580 220 -220 590 -220 220 595 -220 -220 605;
     600 100 610 100 600 600 -600 -100 590 -100 -600 620];
for i = 6:n
  x(i, :) = low + rand(1, 12) .* (high - low);
end
f = zeros(n, 2);
for i = 1:n
  f(i, :) = objectives(x(i, :));
end
rank = sort_fronts(f);
distance = zeros(n, 1);
for k = 1:max(rank)
  distance(rank == k) = crowding(f(rank == k, :));
end
for g = 1:generations
  children = zeros(n, 12);
  for i = 1:2:n
    [a, b] = cross(x(tournament(rank, distance), :), x(tournament(rank, distance), :), low, high);
    children(i, :) = mutate(a, low, high);
    children(min(i + 1, n), :) = mutate(b, low, high);
  end
  fc = zeros(n, 2);
  for i = 1:n
    fc(i, :) = objectives(children(i, :));
  end
  x = [x; children];  % Table 7
  f = [f; fc];
  rank = sort_fronts(f);
  distance = zeros(2 * n, 1);
  kept = [];
  k = 1;
  while numel(kept) < n
    front = find(rank == k);
    distance(front) = crowding(f(front, :));
    if numel(kept) + numel(front) > n
      [ignored, order] = sort(distance(front), "descend");
      front = front(order(1:n - numel(kept)));
    end
    kept = [kept; front];
    k = k + 1;
  end
  x = x(kept, :);
  f = f(kept, :);
  rank = rank(kept);
  distance = distance(kept);
end
printf("%.9g\n", cputime() - start);
printf("%.9g %.9g\n", f');
