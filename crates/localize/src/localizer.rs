//! Localization as it goes on: a search, then tracking, and a search again once the robot is lost.
use crate::field::{COARSENESS, Field, float};
use crate::model::{FAR, Model, Move, Wander};
use crate::particles::{Cluster, Count, Particle, Particles, beside};
use crate::start::{Look, Place, particles, places, spread_particles};
use ev3_motion::{Pose, distance, wrapped};
use rand_pcg::Pcg32;

/// Looks that a search needs, and over how many degrees.
const LOOKS: usize = 70;
const AROUND: f64 = 250.0;
/// Looks from farther back on the way than this do not count for it, in cm.
const WAY: f64 = 150.0;
/// Looks so near to the last one, in degrees and cm, add nothing new.
const SAME_LOOK: [f64; 2] = [2.0, 2.0];
/// A new measurement counts for so much of the fit.
const SMOOTH: f64 = 0.03;
/// Below this fit the robot is lost.
const LOST: f64 = 0.35;
/// Below this fit a look around is searched for though the robot is not lost: it may be at a
/// place that looks like the right one.
const DOUBT: f64 = 0.8;
/// The share of the probability that a search gives the places that it finds.
const FOUND: [f64; 2] = [0.5, 0.7];
/// Of those, places that are less probable are left out.
const LEAST_PROBABLE: f64 = 0.002;
/// The least number of particles of a place.
const LEAST_OF_PLACE: f64 = 30.0;
/// A place belongs to a cluster that is so near, in cm and degrees.
const IN_CLUSTER: [f64; 2] = [20.0, 20.0];

/// A cluster with this share of the probability and this deviation in cm is the robot's place.
const SURE: f64 = 0.9;
const NARROW: f64 = 10.0;

/// What a localizer does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// How the sensor measures.
    pub model: Model,
    /// How the odometry errs.
    pub wander: Wander,
    /// Where the sensor is: x to the right and y ahead of the robot's middle, and its heading.
    pub sensor: Pose,
    /// How many particles there are.
    pub count: Count,
    /// After which way in cm or turn in degrees a measurement counts.
    pub update: [f64; 2],
    /// The seed of the random numbers.
    pub seed: u64,
    /// Whether an unknown place is searched for by a look around. Else particles are spread over
    /// all of the map, and weighed from the first measurement on, as textbooks have it: they are
    /// soon sure of a wrong place.
    pub search: bool,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            model: Model::default(),
            wander: Wander::GYRO,
            sensor: Pose { x: 0.0, y: 7.0, heading: 0.0 },
            count: Count::Adaptive(500, 5000),
            update: [2.0, 4.0],
            seed: 1,
            search: true,
        }
    }
}

/// What a measurement has changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// Nothing: the robot has hardly moved, or more looks are needed.
    Nothing,
    /// The poses that are possible have been weighed.
    Tracked,
    /// A search has found where it may be.
    Found,
    /// The measurements contradict all poses: it must look around.
    Lost,
}

/// Where a robot may be.
#[derive(Clone, Debug)]
pub struct Localizer {
    field: Field,
    options: Options,
    generator: Pcg32,
    particles: Particles,
    /// Whether the particles are tracked; else a search begins when enough is seen.
    is_tracking: bool,
    looks: Vec<Look>,
    /// By odometry, where it was when particles were moved, and weighed.
    moved: Option<Pose>,
    weighed: Option<Pose>,
    fit: f64,
}

impl Localizer {
    /// A robot that may be anywhere.
    pub fn new(field: Field, mut options: Options) -> Localizer {
        if field.has_table() {
            options.model.sigma[0] += COARSENESS;
        }
        let generator = Pcg32::new(options.seed, 1);
        let mut localizer = Localizer {
            field,
            options,
            generator,
            particles: Particles::default(),
            is_tracking: false,
            looks: Vec::new(),
            moved: None,
            weighed: None,
            fit: 0.0,
        };
        localizer.reset();
        localizer
    }

    /// The robot is at a pose, with a standard deviation in cm, and half of that in degrees.
    pub fn start_at(&mut self, pose: Pose, deviation: f64) {
        let count = self.least_count();
        let deviation = [deviation, deviation / 2.0];
        let particle = |()| Particle {
            pose: beside(pose, deviation, &mut self.generator),
            weight: 1.0 / float(count),
        };
        self.particles.all = std::iter::repeat_n((), count).map(particle).collect();
        self.track(1.0);
    }

    /// It may be anywhere again.
    pub fn reset(&mut self) {
        self.particles.all.clear();
        self.is_tracking = false;
        self.looks.clear();
        self.fit = 0.0;
        if !self.options.search {
            let (Count::Fixed(count) | Count::Adaptive(_, count)) = self.options.count;
            self.particles = spread_particles(&self.field, count, &mut self.generator);
            self.track(1.0);
        }
    }

    fn track(&mut self, fit: f64) {
        self.is_tracking = true;
        self.fit = fit;
        self.moved = None;
        self.weighed = None;
    }

    /// Takes a measurement: the pose by odometry, and what is heard, in cm; 255 or more is nothing.
    pub fn step(&mut self, odometry: Pose, heard: f64) -> Step {
        let heard = (heard < FAR).then_some(heard);
        let is_new = self.remember(Look { pose: odometry, heard });
        let step = if self.is_tracking {
            self.follow(odometry, heard)
        } else {
            self.go(odometry);
            Step::Nothing
        };
        let may_search = self.options.search && (!self.is_tracking || self.fit < DOUBT);
        if is_new && may_search && self.has_looked_around() { self.search(step) } else { step }
    }

    /// Whether the look is kept for a search.
    fn remember(&mut self, look: Look) -> bool {
        let is_same =
            self.looks.last().is_some_and(|last| !has_moved(last.pose, look.pose, SAME_LOOK));
        if is_same {
            return false;
        }
        self.looks.push(look);
        let pairs = self.looks.windows(2).rev();
        let mut way = 0.0;
        let kept = pairs.take_while(|pair| {
            way += distance(pair[0].pose.point(), pair[1].pose.point());
            way <= WAY
        });
        let kept = kept.count() + 1;
        let most = 2 * LOOKS;
        self.looks.drain(..self.looks.len() - kept.min(most));
        true
    }

    fn has_looked_around(&self) -> bool {
        let headings = self.looks.iter().map(|look| look.pose.heading);
        let low = headings.clone().fold(f64::INFINITY, f64::min);
        let high = headings.fold(f64::NEG_INFINITY, f64::max);
        self.looks.len() >= LOOKS && high - low >= AROUND
    }

    fn sensor(&self) -> Move {
        Move::between(Pose::default(), self.options.sensor)
    }

    /// Searches for the looks on all of the map, and adds the places that are found; what it
    /// believed before keeps a share.
    fn search(&mut self, before: Step) -> Step {
        let (field, model, sensor) = (&self.field, &self.options.model, self.sensor());
        let places = places(field, model, sensor, &self.looks, &mut self.generator);
        let fit: f64 = places.iter().map(|place| place.weight * place.fit).sum();
        let last = self.looks.last().map(|look| look.pose);
        if fit < LOST {
            // The next half turn may fit better.
            self.looks.drain(..self.looks.len() / 2);
            return before;
        }
        self.looks.clear();
        let known = self.particles.clusters();
        let is_known = |place: &Place| {
            known.iter().any(|cluster| !has_moved(cluster.pose, place.pose, IN_CLUSTER))
        };
        let is_new = |place: &Place| place.weight > LEAST_PROBABLE && !is_known(place);
        let new: Vec<Place> = places.into_iter().filter(is_new).collect();
        let share: f64 = new.iter().map(|place| place.weight).sum();
        let share = match (known.is_empty(), self.is_tracking) {
            (true, _) => 1.0,
            (false, true) => share * FOUND[0],
            (false, false) => share * FOUND[1],
        };
        if !new.is_empty() {
            let count = self.least_count();
            let found = particles(&new, count, LEAST_OF_PLACE, &mut self.generator);
            self.particles.add(found, share);
        }
        if self.is_tracking {
            return before;
        }
        self.track(fit);
        self.moved = last;
        self.weighed = last;
        Step::Found
    }

    fn least_count(&self) -> usize {
        match self.options.count {
            Count::Fixed(count) => count,
            Count::Adaptive(least, _) => least,
        }
    }

    /// Moves the particles with the robot.
    fn go(&mut self, odometry: Pose) {
        let from = self.moved.replace(odometry).unwrap_or(odometry);
        let moved = Move::between(from, odometry);
        self.particles.go(moved, self.options.wander, &mut self.generator);
    }

    fn follow(&mut self, odometry: Pose, heard: Option<f64>) -> Step {
        if self.weighed.is_some_and(|last| !has_moved(last, odometry, self.options.update)) {
            return Step::Nothing;
        }
        self.go(odometry);
        self.weighed = Some(odometry);
        let sensor = self.sensor();
        let fit = self.particles.weigh(&self.field, &self.options.model, sensor, heard);
        self.fit += SMOOTH * (fit - self.fit);
        if self.fit < LOST && self.options.search {
            self.is_tracking = false;
            // What was heard before it was lost fits no place together with what comes.
            self.looks.clear();
            return Step::Lost;
        }
        if self.particles.effective() < float(self.particles.all.len()) / 2.0 {
            self.particles.resample(self.options.count, &mut self.generator);
        }
        Step::Tracked
    }

    /// The clusters, the most probable one first; none before the first search.
    pub fn clusters(&self) -> Vec<Cluster> {
        self.particles.clusters()
    }

    /// The most probable cluster.
    pub fn best(&self) -> Option<Cluster> {
        self.clusters().first().copied()
    }

    /// How far it is sure of the most probable cluster, from 0 to 1: that cluster's share of the
    /// probability, times how well the measurements fit.
    pub fn confidence(&self) -> f64 {
        self.best().map_or(0.0, |best| best.weight * self.fit)
    }

    /// The most probable cluster, moved on by odometry since it was measured.
    pub fn best_now(&self, odometry: Pose) -> Option<Cluster> {
        let best = self.best()?;
        let since = Move::between(self.moved.unwrap_or(odometry), odometry);
        let pose = since.from(best.pose);
        Some(Cluster { pose: Pose { heading: wrapped(pose.heading), ..pose }, ..best })
    }

    /// The most probable cluster, if it may correct the odometry.
    pub fn sure(&self, odometry: Pose) -> Option<Cluster> {
        self.best_now(odometry)
            .filter(|best| self.is_tracking && best.weight >= SURE && best.deviation() <= NARROW)
    }

    /// How well the measurements fit, from 0 to 1.
    pub fn fit(&self) -> f64 {
        self.fit
    }

    /// Whether it must look around: it does not know where it is.
    pub fn must_look(&self) -> bool {
        !self.is_tracking
    }

    /// All particles.
    pub fn particles(&self) -> &[Particle] {
        &self.particles.all
    }

    /// The map.
    pub fn field(&self) -> &Field {
        &self.field
    }
}

fn has_moved(from: Pose, to: Pose, [way, turn]: [f64; 2]) -> bool {
    distance(from.point(), to.point()) >= way || wrapped(to.heading - from.heading).abs() >= turn
}

#[cfg(test)]
mod tests {
    use super::*;
    use ev3_roadmap::{Bounds, Map, Obstacle};

    fn room() -> Field {
        let obstacles = vec![
            Obstacle::rectangle([90.0, 165.0], 40.0, 25.0, 20.0).unwrap(),
            Obstacle::rectangle([200.0, 90.0], 30.0, 45.0, -15.0).unwrap(),
            Obstacle::circle([150.0, 125.0], 8.0).unwrap(),
        ];
        let bounds = Bounds { low: [0.0, 0.0], high: [300.0, 250.0] };
        Field::new(&Map::new(obstacles, Some(bounds)).unwrap(), 8.0, 15.0).unwrap()
    }

    /// Turns once around, by odometry at the origin; returns the last step that changed much.
    fn look_around(localizer: &mut Localizer, there: Pose, from: Pose) -> Step {
        let field = localizer.field().clone();
        let mut last = Step::Nothing;
        for look in 1..=100 {
            let turn = f64::from(look) * 3.7;
            let turned = |pose: Pose| Pose { heading: pose.heading + turn, ..pose };
            let heard = field.heard(turned(there).ahead(7.0)).unwrap_or(FAR);
            match localizer.step(turned(from), heard) {
                step @ (Step::Found | Step::Lost) => last = step,
                Step::Nothing | Step::Tracked => {}
            }
        }
        last
    }

    fn off(localizer: &Localizer, there: Pose) -> f64 {
        let best = localizer.best().unwrap().pose;
        distance(best.point(), there.point()) + wrapped(best.heading - there.heading).abs()
    }

    #[test]
    fn it_finds_itself_and_notices_that_it_was_carried_away() {
        let mut localizer = Localizer::new(room(), Options::default());
        let origin = Pose::default();
        let here = Pose { x: 60.0, y: 60.0, heading: 30.0 };
        assert!(localizer.must_look() && localizer.best().is_none());
        assert_eq!(look_around(&mut localizer, here, origin), Step::Found);
        let end = Pose { heading: here.heading + 370.0, ..here };
        assert!(off(&localizer, end) < 3.0, "{:?}", localizer.best());
        assert!(localizer.confidence() > 0.9);
        let there = Pose { x: 250.0, y: 200.0, heading: 0.0 };
        look_around(&mut localizer, there, Pose { heading: 370.0, ..origin });
        look_around(&mut localizer, there, Pose { heading: 740.0, ..origin });
        let end = Pose { heading: there.heading + 370.0, ..there };
        assert!(off(&localizer, end) < 3.0, "{:?}", localizer.best());
    }

    #[test]
    fn a_known_start_is_followed_and_moves_on_with_odometry() {
        let mut localizer = Localizer::new(room(), Options::default());
        let start = Pose { x: 40.0, y: 40.0, heading: 0.0 };
        localizer.start_at(start, 2.0);
        for way in 0..150_u32 {
            let there = start.ahead(f64::from(way));
            let heard = localizer.field().heard(there.ahead(7.0)).unwrap_or(FAR);
            // By wheels that are 3 % too small.
            localizer.step(Pose::default().ahead(f64::from(way) * 1.03), heard);
        }
        let end = start.ahead(149.0);
        assert!(off(&localizer, end) < 4.0, "{:?}", localizer.best());
        let odometry = Pose::default().ahead(149.0 * 1.03 + 20.0);
        let now = localizer.best_now(odometry).unwrap().pose;
        assert!((now.y - localizer.best().unwrap().pose.y - 20.0).abs() < 2.5, "{now:?}");
        assert!(localizer.sure(odometry).is_some());
        localizer.reset();
        assert!(localizer.best().is_none() && localizer.confidence() <= 0.0);
    }

    #[test]
    fn where_two_places_look_alike_both_are_told() {
        let bounds = Bounds { low: [0.0, 0.0], high: [300.0, 200.0] };
        let field = Field::new(&Map::new(Vec::new(), Some(bounds)).unwrap(), 8.0, 15.0).unwrap();
        let mut localizer = Localizer::new(field, Options::default());
        look_around(&mut localizer, Pose { x: 80.0, y: 60.0, heading: 0.0 }, Pose::default());
        let clusters = localizer.clusters();
        assert_eq!(clusters.iter().filter(|cluster| cluster.weight > 0.2).count(), 2);
        assert!(localizer.confidence() < 0.7);
        let sum: f64 = clusters.iter().map(|cluster| cluster.weight).sum();
        assert!((sum - 1.0).abs() < 1e-9);
    }

    #[test]
    fn the_number_of_particles_follows_the_uncertainty() {
        let mut localizer = Localizer::new(room(), Options::default());
        localizer.start_at(Pose { x: 40.0, y: 40.0, heading: 0.0 }, 2.0);
        assert_eq!(localizer.particles().len(), 500);
        let options = Options { count: Count::Fixed(1000), search: false, ..Options::default() };
        let spread = Localizer::new(room(), options);
        assert_eq!(spread.particles().len(), 1000);
        assert!(!spread.must_look());
    }
}
