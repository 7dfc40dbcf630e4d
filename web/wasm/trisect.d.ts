// SPDX-License-Identifier: Apache-2.0
//
// Types of the package trisect: exact solid modelling in WebAssembly.

/** Where a module is: its bytes, compiled, or its address. */
export type ModuleSource = WebAssembly.Module | ArrayBuffer | ArrayBufferView | URL | string;
export interface InitOptions {
  /** Where the second module is, by default trisect-more.wasm beside the script; false: it is not loaded. */
  more?: ModuleSource | false;
}
/**
 * Loads the module, by default trisect.wasm beside the script, and the second one. Await it once, before anything else is
 * called. Solids, booleans, meshes, measures, points and sections are in the first module: with { more: false } they work
 * when less is loaded, all else fails with 'usage', and a later init() adds it.
 */
export function init(source?: ModuleSource, options?: InitOptions): Promise<void>;
/** Of the library, as "0.1.0". */
export function version(): string;

export type ErrorKind =
  | 'usage' | 'input' | 'invalid_solid' | 'limit' | 'cancelled' | 'unsupported' | 'internal' | 'no_memory';
/** What went wrong; the message names the place. */
export class TrisectError extends Error {
  readonly kind: ErrorKind;
}

export type Vector = readonly [number, number, number];
/** The plane p[0] x + p[1] y + p[2] z + p[3] = 0. */
export type Plane = readonly [number, number, number, number];
/** The matrix (M | t), row by row: twelve numbers. */
export type Rows = readonly number[];
/** Three numbers a point, one after the other. */
export type Numbers = Float64Array | readonly number[];
export type Indices = Uint32Array | readonly number[];

/** Something that lies in the module's memory. */
declare class Handle {
  /** Gives the memory back. What is never deleted is given back some time after it was forgotten. */
  delete(): void;
  [Symbol.dispose](): void;
}

export interface SolidOptions {
  /** Whether the boundary may meet itself: it does not ('assume'), it may ('resolve'), or find out ('check'). */
  embedding?: 'assume' | 'resolve' | 'check';
  /** For faces of any number of corners: face f has the corners from faceBegin[f] up to faceBegin[f + 1]. */
  faceBegin?: Indices;
  acceptInsideOut?: boolean;
}

export interface Mesh {
  vertices: Float64Array;
  faces: Uint32Array;
  /** Two numbers a face: its operand (Solid.sourceId) and that operand's face. */
  sources: Uint32Array;
}

export interface Hit {
  /** In lengths of the direction. */
  parameter: number;
  operand: number;
  face: number;
}

export interface Loop {
  /** The number of its region. The outline of each region comes first. */
  region: number;
  isHole: boolean;
  points: Float64Array;
}

export const Location: {
  readonly OUTSIDE: 0;
  readonly ON_FACE: 1;
  readonly ON_EDGE: 2;
  readonly ON_VERTEX: 3;
  readonly INSIDE: 4;
};

/** A set of points with a boundary of planar faces. Never changes. */
export class Solid extends Handle {
  /** Of triangles, counter-clockwise seen from outside. Throws with the place where they bound no solid. */
  constructor(vertices: Numbers, faces: Indices, options?: SolidOptions);
  static empty(): Solid;
  static wholeSpace(): Solid;
  /** The points with p[0] x + p[1] y + p[2] z + p[3] <= 0. */
  static halfSpace(plane: Plane): Solid;
  static box(low: Vector, high: Vector): Solid;
  /** About the z axis, from z = 0 upwards. */
  static cylinder(radius: number, height: number, segments?: number): Solid;
  static cone(bottomRadius: number, topRadius: number, height: number, segments?: number): Solid;
  /** 20 * 4^subdivisions triangles. */
  static sphere(radius: number, subdivisions?: number): Solid;
  static torus(majorRadius: number, minorRadius: number, majorSegments?: number, minorSegments?: number): Solid;
  /** To the last bit, of exactText. */
  static fromExactText(text: string): Solid;
  /** Of a program in OpenSCAD's evaluated form (.csg). Files are not read. */
  static fromCsg(text: string): Solid;

  union(...others: Solid[]): Solid;
  intersection(...others: Solid[]): Solid;
  /** Without all others. */
  difference(...others: Solid[]): Solid;
  /** Points in an odd number of operands. */
  xor(...others: Solid[]): Solid;
  complement(): Solid;
  /** Another object of the same solid; costs nothing. */
  copy(): Solid;
  /** The parts below and above a plane, or inside and outside of another solid. */
  split(by: Plane | Solid): [Solid, Solid];
  /** The connected parts. */
  components(): Solid[];

  /** Maps that keep the lattice of coordinates are exact; of others each vertex is rounded once. */
  transform(rows: Rows): Solid;
  /** And how far the vertex went that was rounded most; 0 says that none was. */
  transformWithReport(rows: Rows): { solid: Solid; largestMove: number };
  translate(by: Vector): Solid;
  scale(by: number | Vector): Solid;
  rotate(axis: Vector, degrees: number): Solid;

  /** The boundary as triangles; coordinates are rounded once. */
  mesh(): Mesh;
  /** What `sources` of results call this operand, of a solid made of a mesh. */
  readonly sourceId: number;
  readonly isEmpty: boolean;
  readonly isWholeSpace: boolean;
  /** Whether both are the same set, exactly. */
  equals(other: Solid): boolean;
  readonly exactText: string;

  /** The exact value, rounded once; so is area. */
  readonly volume: number;
  readonly area: number;
  /** "p" or "p/q" in decimal. */
  readonly exactVolume: string;
  /** Throws for the empty set. */
  readonly centroid: number[];
  readonly bounds: { low: number[]; high: number[] };

  /** One number of Location a point. */
  locate(points: Numbers): Uint8Array;
  firstHit(origin: Vector, direction: Vector): Hit | null;
  /** Infinity where nothing is hit; `faces` has two numbers a ray, the operand and its face. */
  firstHits(origins: Numbers, directions: Numbers): { parameters: Float64Array; faces: Uint32Array };
  /** Below 0 inside, 0 on the boundary: the sign is exact. */
  signedDistances(points: Numbers): Float64Array;
  section(plane: Plane): Loop[];
}

/** Of any number of operands, in one pass. */
export function union(operands: Iterable<Solid>): Solid;
export function intersection(operands: Iterable<Solid>): Solid;
export function xor(operands: Iterable<Solid>): Solid;
export function difference(from: Solid, others: Iterable<Solid>): Solid;

/** An exact affine map. */
export class Pose extends Handle {
  constructor(rows: Rows);
  static translation(by: Vector): Pose;
  /** The rotation by the quaternion (w, x, y, z) of integers, then a translation. */
  static fromQuaternion(quaternion: readonly (number | bigint)[], translation?: Vector): Pose;
  /** First the other one, then this one. */
  times(other: Pose): Pose;
  inverse(): Pose;
  /** The numbers nearest in double precision. */
  readonly rows: number[];
}

export type Relation = 'disjoint' | 'touching' | 'overlapping' | 'inside' | 'contains' | 'equal';
type AnyPose = Pose | null | undefined;
/** How solid a under its pose lies to solid b under its pose, exactly. No pose stands for the identity. */
export function interfere(a: Solid, poseA: AnyPose, b: Solid, poseB: AnyPose): Relation;
/** Of the boundaries: lower <= distance <= upper. */
export function distance(a: Solid, poseA: AnyPose, b: Solid, poseB: AnyPose): { lower: number; upper: number };
export function areNearerThan(a: Solid, poseA: AnyPose, b: Solid, poseB: AnyPose, distance: number): boolean;

/** A pose for every parameter from 0 to 1. */
export class Motion extends Handle {
  private constructor();
  static still(pose?: AnyPose): Motion;
  static translation(start: AnyPose, by: Vector): Motion;
  static screw(start: AnyPose, quaternion: readonly (number | bigint)[], center: Vector, shift?: Vector): Motion;
}
/** The first time at which the solids meet, or from which on their interiors do; null is a proof that they never do. */
export function firstContact(
  a: Solid, motionA: Motion | null, b: Solid, motionB: Motion | null, options?: { untilOverlap?: boolean },
): number | null;

export interface Body {
  readonly index: number;
  readonly generation: number;
}
/** Many solids under poses. */
export class Scene extends Handle {
  add(solid: Solid, pose?: AnyPose): Body;
  setPose(body: Body, pose: AnyPose): void;
  replace(body: Body, solid: Solid): void;
  remove(body: Body): void;
  /** All pairs that are not disjoint. */
  interfering(): { a: Body; b: Body; relation: Relation }[];
}

export interface Finding {
  /** Such as "open_edge". */
  kind: string;
  isError: boolean;
  place: number[];
  sentence: string;
  vertices: Uint32Array;
  faces: Uint32Array;
}
/** What keeps triangles from bounding a solid. */
export function check(vertices: Numbers, faces: Indices): { isSolid: boolean; findings: Finding[] };

export interface Triangles {
  vertices: Numbers;
  faces: Indices;
}
/** Proves that a mesh is the result of a boolean, up to a distance where `within` is not negative, or that it is not. */
export function verify(
  operation: 'union' | 'intersection' | 'difference' | 'xor', operands: readonly Triangles[], result: Triangles, within?: number,
): { verdict: 'equal' | 'within' | 'different' | 'undecided' | 'not_closed'; lower: number; upper: number };

/** For all calls from now on: units of work of a call, and bytes of a boolean. 0 is no limit. */
export function setLimits(limits?: { maxWork?: number; maxMemory?: number }): void;
